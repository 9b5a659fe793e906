#include "depth_normals.h"

namespace penumbra::shadow {

namespace {

std::string target_name(const ViewState& view) { return view.prefix + "normals from depth"; }

}  // namespace

void drop_normals(gl::Device& device, ViewState& view) {
  if (view.has_normals) device.drop(target_name(view));
  view.has_normals = false;
}

LibraryProgram depth_normals_program(bool guided) {
  return {.desc = {.name = "normals from depth",
                   .vertex = "shared/full_screen.vert",
                   .fragment = "shadow/drivers/normals_from_depth.frag",
                   .defines = {{"GUIDED", guided ? "1" : "0"}}}};
}

void make_normals(const LightWork& work, ViewState& view) {
  if (!work.inputs.makes_normals() || view.normals != nullptr) return;
  view.has_normals = true;
  const gl::Texture& normals =
      work.device.target(target_name(work.view),
                         {.format = GL_RGBA32F, .width = work.inputs.depth.width, .height = work.inputs.depth.height});
  gl::Pass pass(work.device, {.name = "normals from depth", .colors = {{.texture = &normals}}});
  const bool guided = work.inputs.normals.id != 0;
  const gl::Program& program = pass.use(work.programs.ready(depth_normals_program(guided)));
  if (guided) {
    const Conventions& conventions = work.inputs.conventions;
    program.set("decode", glm::vec2(conventions.normals_scale, conventions.normals_offset));
    program.set("octahedral", conventions.octahedral_normals ? 1 : 0);
  }
  work.state.params_block->bind_uniform(block_params);
  work.state.shadow_block->bind_uniform(block_shadow);
  bind_receivers(work);
  const Rect& viewport = work.frame.viewport;
  pass.set_viewport(viewport.x, viewport.y, viewport.width, viewport.height);
  pass.draw_full_screen();
  view.normals = &normals;
}

}  // namespace penumbra::shadow

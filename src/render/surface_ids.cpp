#include "render/passes.h"

namespace penumbra::render {

namespace {

gl::ProgramDesc id_program(scene::Surfaces surfaces) {
  const bool masked = surfaces == scene::Surfaces::masked;
  return {.name = masked ? "masked surface ids" : "surface ids",
          .vertex = "scene/surface.vert",
          .fragment = "render/surface_ids.frag",
          .defines = {{"MASKED", masked ? "1" : "0"}}};
}

}  // namespace

const gl::Texture& draw_surface_ids(gl::Device& device, const SurfaceIdInputs& inputs) {
  const auto target = [&](const char* name, GLenum format) {
    return &device.target(name, {.format = format,
                                 .width = static_cast<int>(inputs.view.viewport.x),
                                 .height = static_cast<int>(inputs.view.viewport.y)});
  };
  const gl::Texture* ids = target("surface ids", GL_RG32UI);
  const gl::Texture* depth = target("surface ids' depth", GL_DEPTH_COMPONENT32F);
  const glm::vec4 nothing(0.0f);
  // Same depth test and draw order as the G-buffer, so that the same one of coplanar triangles is visible.
  gl::Pass pass(device, {.name = "surface ids",
                         .colors = {{.texture = ids, .clear = nothing}},
                         .depth = gl::Attachment{.texture = depth, .clear = nothing},
                         .depth_test = gl::DepthTest::greater_equal,
                         .depth_write = true});
  const Frustum frustum(inputs.view.world_to_clip);
  const auto visible = [&](const scene::Bounds& box) { return frustum.holds(box); };
  for (const scene::Surfaces surfaces : {scene::Surfaces::opaque, scene::Surfaces::masked})
    inputs.scene.draw_surfaces(device, pass, surfaces, id_program(surfaces), visible);
  return *ids;
}

std::vector<gl::ProgramDesc> surface_id_programs() {
  return {id_program(scene::Surfaces::opaque), id_program(scene::Surfaces::masked)};
}

}  // namespace penumbra::render

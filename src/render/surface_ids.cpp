#include "render/passes.h"
#include "shared/scene_blocks.h"

namespace penumbra::render {

namespace {

constexpr unsigned base_color = 1u << TEXTURE_BASE_COLOR;

// Colours matter only to the alpha test.
gl::ProgramDesc program(const scene::SurfaceTraits& traits) {
  scene::SurfaceTraits read{.masked = traits.masked, .triangles = traits.triangles};
  if (traits.masked) {
    read.textures = traits.textures & base_color;
    read.transforms = traits.transforms & base_color;
    read.colors = traits.colors;
  }
  return {.name = "surface ids",
          .vertex = "scene/surface.vert",
          .fragment = "render/surface_ids.frag",
          .defines = scene::surface_defines(read, {})};
}

}  // namespace

const gl::Texture& draw_surface_ids(gl::Device& device, const SurfaceIdInputs& inputs) {
  const gl::Texture& ids = device.target(
      "surface ids", {.format = GL_RG32UI, .width = inputs.depth.width(), .height = inputs.depth.height()});
  // The same depth, test and order as in the G-buffer, so that the same one of coplanar triangles is visible.
  gl::Pass pass(device, {.name = "surface ids",
                         .colors = {{.texture = &ids, .clear = glm::vec4(0.0f)}},
                         .depth = gl::Attachment{.texture = &inputs.depth},
                         .depth_test = gl::DepthTest::equal});
  const Frustum frustum(inputs.view.world_to_clip);
  inputs.scene.draw_surfaces(
      device, pass, [&](const scene::SurfaceTraits& traits) { pass.use(program(traits)); },
      [&](const scene::Bounds& box) { return frustum.holds(box); });
  return ids;
}

std::vector<gl::ProgramDesc> surface_id_programs() {
  return {program({}), program({.triangles = false}), program({.masked = true}),
          program({.textures = base_color, .transforms = base_color, .colors = true, .masked = true})};
}

}  // namespace penumbra::render

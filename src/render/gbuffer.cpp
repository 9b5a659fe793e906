#include "render/passes.h"

namespace penumbra::render {

namespace {

gl::ProgramDesc surface_program(scene::Surfaces surfaces) {
  const bool masked = surfaces == scene::Surfaces::masked;
  return {.name = masked ? "masked surfaces" : "opaque surfaces",
          .vertex = "scene/surface.vert",
          .fragment = "render/gbuffer.frag",
          .defines = {{"MASKED", masked ? "1" : "0"}}};
}

}  // namespace

GBuffer draw_gbuffer(gl::Device& device, const GBufferInputs& inputs) {
  const auto target = [&](const char* name, GLenum format) {
    return &device.target(name, {.format = format,
                                 .width = static_cast<int>(inputs.view.viewport.x),
                                 .height = static_cast<int>(inputs.view.viewport.y)});
  };
  const GBuffer gbuffer{.albedo = target("albedo", GL_RGB10_A2),
                        .normal = target("shading normal", GL_RG16),
                        .geometric_normal = target("geometric normal", GL_RG32F),
                        .material = target("material", GL_RGBA8),
                        .emission = target("emission", GL_R11F_G11F_B10F),
                        .motion = target("motion", GL_RG32F),
                        .depth = target("depth", GL_DEPTH_COMPONENT32F)};
  const glm::vec4 nothing(0.0f);
  gl::Pass pass(device, {.name = "gbuffer",
                         .colors = {{.texture = gbuffer.albedo, .clear = nothing},
                                    {.texture = gbuffer.normal, .clear = glm::vec4(0.5f)},
                                    {.texture = gbuffer.geometric_normal, .clear = nothing},
                                    {.texture = gbuffer.material, .clear = nothing},
                                    {.texture = gbuffer.emission, .clear = nothing},
                                    {.texture = gbuffer.motion, .clear = nothing}},
                         .depth = gl::Attachment{.texture = gbuffer.depth, .clear = nothing},
                         .depth_test = gl::DepthTest::greater_equal,
                         .depth_write = true});
  const Frustum frustum(inputs.view.world_to_clip);
  const auto visible = [&](const scene::Bounds& box) { return frustum.holds(box); };
  for (const scene::Surfaces surfaces : {scene::Surfaces::opaque, scene::Surfaces::masked}) {
    inputs.scene.draw_surfaces(device, pass, surfaces, surface_program(surfaces), visible);
  }
  return gbuffer;
}

std::vector<gl::ProgramDesc> gbuffer_programs() {
  return {surface_program(scene::Surfaces::opaque), surface_program(scene::Surfaces::masked)};
}

}  // namespace penumbra::render

#include <string>

#include "render/passes.h"
#include "shared/scene_blocks.h"

namespace penumbra::render {

namespace {

// Which of the optional targets a program writes.
struct Optional {
  bool emission = false, motion = false;
};

gl::ProgramDesc program(scene::SurfaceTraits traits, const Optional& writes) {
  if (!writes.emission) traits.textures &= ~(1u << TEXTURE_EMISSIVE);
  traits.transforms &= traits.textures;
  gl::ProgramDesc desc{.name = "surfaces",
                       .vertex = "scene/surface.vert",
                       .fragment = "render/gbuffer.frag",
                       .defines = scene::surface_defines(traits, {.normals = true, .motion = writes.motion})};
  desc.defines.push_back({"EMISSION", writes.emission ? "1" : "0"});
  return desc;
}

// How far the nearest corner of a box is in front of the camera, metres.
float distance_to(const scene::Bounds& box, const glsl::ViewBlock& view) {
  const glm::vec3 forward(view.forward);
  return glm::dot(forward, box.center() - glm::vec3(view.camera)) - glm::dot(glm::abs(forward), box.extent()) * 0.5f;
}

}  // namespace

GBuffer draw_gbuffer(gl::Device& device, const GBufferInputs& inputs) {
  const bool further = inputs.sample == Sample::further;
  const auto target = [&](const std::string& name, GLenum format) {
    return &device.target(further ? "sample " + name : name, {.format = format,
                                                              .width = static_cast<int>(inputs.view.viewport.x),
                                                              .height = static_cast<int>(inputs.view.viewport.y)});
  };
  const Optional writes{.emission = inputs.scene.has_emissive(), .motion = inputs.motion};
  const GBuffer gbuffer{.albedo = target("albedo", GL_RGB10_A2),
                        .normal = target("shading normal", GL_RG16),
                        .geometric_normal = target("geometric normal", GL_RG32F),
                        .material = target("material", GL_RGBA8),
                        .emission = writes.emission ? target("emission", GL_R11F_G11F_B10F) : nullptr,
                        .motion = writes.motion ? target("motion", GL_RG32F) : nullptr,
                        .depth = target("depth", GL_DEPTH_COMPONENT32F)};
  const Frustum frustum(inputs.view.world_to_clip);
  const auto visible = [&](const scene::Bounds& box) { return frustum.holds(box); };
  const glm::vec4 nothing(0.0f);
  {
    gl::Pass pass(device, {.name = further ? "sample depth" : "depth",
                           .depth = gl::Attachment{.texture = gbuffer.depth, .clear = nothing},
                           .depth_test = gl::DepthTest::greater_equal,
                           .depth_write = true});
    inputs.scene.draw_depth(device, pass, inputs.view.world_to_clip, visible,
                            [&](const scene::Bounds& box) { return distance_to(box, inputs.view); });
  }
  std::vector<gl::Attachment> colors{{.texture = gbuffer.albedo, .clear = nothing},
                                     {.texture = gbuffer.normal, .clear = glm::vec4(0.5f)},
                                     {.texture = gbuffer.geometric_normal, .clear = nothing},
                                     {.texture = gbuffer.material, .clear = nothing}};
  for (const gl::Texture* texture : {gbuffer.emission, gbuffer.motion}) {
    if (texture != nullptr) colors.push_back({.texture = texture, .clear = nothing});
  }
  gl::Pass pass(device, {.name = further ? "sample gbuffer" : "gbuffer",
                         .colors = colors,
                         .depth = gl::Attachment{.texture = gbuffer.depth},
                         .depth_test = gl::DepthTest::equal});
  const auto use = [&](const scene::SurfaceTraits& traits) { pass.use(program(traits, writes)); };
  inputs.scene.draw_surfaces(device, pass, use, visible);
  return gbuffer;
}

std::vector<gl::ProgramDesc> gbuffer_programs() {
  std::vector<gl::ProgramDesc> programs;
  for (const scene::SurfaceTraits& traits : scene::sample_traits()) {
    for (const bool both : {true, false}) programs.push_back(program(traits, {.emission = both, .motion = both}));
  }
  return programs;
}

}  // namespace penumbra::render

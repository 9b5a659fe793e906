#include "render/passes.h"

namespace penumbra::render {

namespace {

// Shadows of forward surfaces are a technique's function: a generated file puts it before the shading.
std::string put_fragment_shader(gl::ShaderFiles& files, const std::string& forward_include) {
  std::string name = "generated/blended/" + forward_include;
  files.put(name, "#include \"" + forward_include + "\"\n#include \"render/blended.glsl\"\n");
  return name;
}

gl::ProgramDesc program(std::string fragment, std::vector<gl::Define> defines) {
  return {.name = "blended surfaces",
          .vertex = "scene/surface.vert",
          .fragment = std::move(fragment),
          .defines = std::move(defines)};
}

}  // namespace

void draw_blended(gl::Device& device, const BlendedInputs& inputs) {
  if (!inputs.scene.has_blended()) return;
  gl::Pass pass(device, {.name = "blended",
                         .colors = {{.texture = &inputs.lit}},
                         .depth = gl::Attachment{.texture = inputs.gbuffer.depth},
                         .depth_test = gl::DepthTest::greater_equal,
                         .blend = gl::Blend::premultiplied_over});
  const std::string fragment =
      put_fragment_shader(device.shaders.files(), inputs.soft_shadows.forward_include(inputs.params));
  const gl::ProgramDesc desc = program(fragment, inputs.soft_shadows.bind_forward(inputs.mask, 0));
  pass.use(desc).set("world_to_view", inputs.camera.view);
  const Frustum frustum(inputs.view.world_to_clip);
  inputs.scene.draw_blended(device, pass, desc, position_of(inputs.camera),
                            [&](const scene::Bounds& box) { return frustum.holds(box); });
}

std::vector<gl::ProgramDesc> blended_programs(gl::Device& device, const shadow::SoftShadows& soft_shadows,
                                              const ParamSet& defaults) {
  std::vector<gl::ProgramDesc> programs;
  for (const shadow::Technique& technique : soft_shadows.registry().techniques()) {
    ParamSet params = defaults;
    params.set("technique", technique.name);
    const std::string fragment = put_fragment_shader(device.shaders.files(), soft_shadows.forward_include(params));
    // The function is compiled as it is for the mask.
    for (const gl::ProgramDesc& mask : soft_shadows.all_programs(defaults)) {
      if (mask.name == technique.name && !mask.fragment.empty()) programs.push_back(program(fragment, mask.defines));
    }
  }
  return programs;
}

}  // namespace penumbra::render

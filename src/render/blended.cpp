#include "render/passes.h"

namespace penumbra::render {

namespace {

// A forward-shaded surface calls a GLSL function of the shadow technique. The generated shader includes that function
// before the shading code.
std::string put_fragment_shader(gl::ShaderFiles& files, const std::string& forward_include) {
  std::string name = "generated/blended/" + forward_include;
  if (!files.has_generated(name)) {
    files.put(name, "#include \"" + forward_include + "\"\n#include \"render/blended.glsl\"\n");
  }
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
  const shadow::ForwardProgram forward = inputs.soft_shadows.forward_program(inputs.params);
  const gl::ProgramDesc desc = program(put_fragment_shader(device.shaders.files(), forward.include), forward.defines);
  inputs.soft_shadows.bind_forward(inputs.mask, 0);
  pass.use(desc).set("world_to_view", inputs.camera.view);
  const Frustum frustum(inputs.view.world_to_clip);
  inputs.scene.draw_blended(device, pass, desc, position_of(inputs.camera),
                            [&](const scene::Bounds& box) { return frustum.holds(box); });
}

std::vector<gl::ProgramDesc> blended_programs(gl::Device& device, const shadow::SoftShadows& soft_shadows,
                                              const ParamSet& defaults) {
  std::vector<gl::ProgramDesc> programs;
  for (const shadow::ForwardProgram& forward : soft_shadows.all_forward_programs(defaults)) {
    programs.push_back(program(put_fragment_shader(device.shaders.files(), forward.include), forward.defines));
  }
  return programs;
}

}  // namespace penumbra::render

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

gl::ProgramDesc program(std::string fragment, std::vector<gl::Define> defines, bool lamps,
                        const scene::SurfaceTraits& traits) {
  defines.push_back({"LAMPS", lamps ? "1" : "0"});
  for (gl::Define& define : scene::surface_defines(traits, {.normals = true, .world = true}))
    defines.push_back(std::move(define));
  return {.name = "blended surfaces",
          .vertex = "scene/surface.vert",
          .fragment = std::move(fragment),
          .defines = std::move(defines)};
}

}  // namespace

void draw_blended(gl::Device& device, const BlendedInputs& inputs) {
  if (!inputs.scene.has_blended()) return;
  gl::Pass pass(device, {.name = inputs.sample == Sample::further ? "sample blended" : "blended",
                         .colors = {{.texture = &inputs.lit}},
                         .depth = gl::Attachment{.texture = inputs.gbuffer.depth},
                         .depth_test = gl::DepthTest::greater_equal,
                         .blend = gl::Blend::premultiplied_over});
  const shadow::ForwardProgram forward = inputs.soft_shadows.forward_program(inputs.params, inputs.first);
  const std::string fragment = put_fragment_shader(device.shaders.files(), forward.include);
  inputs.soft_shadows.bind_forward(inputs.mask, 0);
  const Frustum frustum(inputs.view.world_to_clip);
  const glm::vec3 eye = position_of(inputs.camera), ahead(inputs.view.forward);
  inputs.scene.draw_blended(
      device, pass,
      [&](const scene::SurfaceTraits& traits) {
        pass.use(program(fragment, forward.defines, inputs.lamps, traits)).set("world_to_view", inputs.camera.view);
      },
      [&](const scene::Bounds& box) { return frustum.holds(box); },
      [&](const scene::Bounds& box) {
        const glm::vec3 away = box.center() - eye;
        return inputs.camera.orthographic ? glm::dot(ahead, away) : glm::length(away);
      });
}

std::vector<gl::ProgramDesc> blended_programs(gl::Device& device, const shadow::SoftShadows& soft_shadows,
                                              const ParamSet& defaults) {
  std::vector<gl::ProgramDesc> programs;
  for (const shadow::ForwardProgram& forward : soft_shadows.all_forward_programs(defaults)) {
    const std::string fragment = put_fragment_shader(device.shaders.files(), forward.include);
    const std::vector<scene::SurfaceTraits> samples = scene::sample_traits();
    for (const scene::SurfaceTraits& traits : {samples[0], samples[1]})
      programs.push_back(program(fragment, forward.defines, /*lamps=*/true, traits));
  }
  return programs;
}

}  // namespace penumbra::render

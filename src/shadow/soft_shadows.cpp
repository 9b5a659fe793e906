#include "soft_shadows.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "../core/error.h"
#include "light_block.h"
#include "shadow_map.h"

namespace penumbra::shadow {

namespace {

// Bindings that glsl/shadow declares.
enum Unit : GLuint { unit_depth, unit_pyramid, unit_receiver_depth, unit_receiver_normal };
enum Block : GLuint { block_params, block_shadow, block_samples };

// The library's rows alone, in the order that GLSL was told of, with the caller's values and the light's own.
ParamSet params_of(const Registry& registry, const ParamSet& params, const Light& light) {
  ParamSet own(registry.params());
  for (const std::string& name : own.names()) own.set(name, params.value(name));
  for (const std::string& assignment : light.overrides) own.assign(assignment);
  return own;
}

std::string generated(const Technique& technique, const char* file) {
  return fmt::format("generated/{}/{}", technique.name, file);
}

// Drivers know no technique: a generated file puts a technique's function before each.
void put_drivers(gl::ShaderFiles& files, const Technique& technique) {
  for (const char* driver : {"mask.frag", "mask.comp", "forward.glsl"}) {
    files.put(generated(technique, driver),
              fmt::format("#include \"{}\"\n#include \"shadow/drivers/{}\"\n", technique.glsl, driver));
  }
}

std::vector<gl::Define> technique_defines(const Technique& technique, const ParamSet& params, bool rotated) {
  std::vector<gl::Define> defines{{"SAMPLE_ROTATE", rotated ? "1" : "0"}};
  for (GlslConstant& constant : compiled_constants(params, technique.name + ".")) {
    defines.push_back({std::move(constant.name), std::move(constant.value)});
  }
  return defines;
}

gl::ProgramDesc mask_program(const Technique& technique, const ParamSet& params, bool rotated, bool compute) {
  gl::ProgramDesc program{.name = technique.name, .defines = technique_defines(technique, params, rotated)};
  if (compute) {
    program.compute = generated(technique, "mask.comp");
  } else {
    program.vertex = "render/full_screen.vert";
    program.fragment = generated(technique, "mask.frag");
  }
  return program;
}

// Parameters that between them build every variant of a technique's programs.
std::vector<ParamSet> compiled_variants(const Technique& technique, const ParamSet& defaults) {
  std::vector<ParamSet> variants{defaults};
  for (const Param& param : defaults.rows()) {
    if (param.binding != ParamBinding::compiled || !param.name.starts_with(technique.name + ".")) continue;
    std::vector<ParamSet> grown;
    for (const ParamSet& variant : variants) {
      for (const ParamValue& value : representative_values(param)) {
        grown.push_back(variant);
        grown.back().set(param.name, value);
      }
    }
    variants = std::move(grown);
  }
  return variants;
}

void check(const FinishedMaps& maps, int light) {
  const size_t count = maps.cascades.items.size();
  if (maps.depth.id == 0) fail("soft shadows: light {} brings no depth texture", light);
  if (count < 1 || count > max_cascades)
    fail("soft shadows: light {} brings {} cascades, 1 to {} fit", light, count, max_cascades);
  if (maps.depth.width != maps.cascades.size || maps.depth.height != maps.cascades.size) {
    fail("soft shadows: light {} brings maps of {}×{} and cascades of {}", light, maps.depth.width, maps.depth.height,
         maps.cascades.size);
  }
}

void check(const Inputs& inputs) {
  if (inputs.depth.id == 0 || inputs.depth.width < 1 || inputs.depth.height < 1) fail("soft shadows: no depth texture");
  if (inputs.normals.id == 0) fail("soft shadows: no normals texture");
  if (inputs.normals.width != inputs.depth.width || inputs.normals.height != inputs.depth.height) {
    fail("soft shadows: normals are {}×{}, depth is {}×{}", inputs.normals.width, inputs.normals.height,
         inputs.depth.width, inputs.depth.height);
  }
  for (const Light& light : inputs.lights) {
    if (!light.maps && !inputs.draw)
      fail("soft shadows: light {} has no maps and there is no caster callback", light.id);
    if (!(glm::length(light.to_light) > 0.5f)) fail("soft shadows: light {} has no direction", light.id);
    if (light.maps) check(*light.maps, light.id);
  }
}

}  // namespace

struct SoftShadows::State {
  struct PerLight {
    ParamSet params;
    Sampling sampling;
    std::array<const gl::Buffer*, 3> blocks{};
  };
  std::vector<PerLight> lights;
};

SoftShadows::SoftShadows(gl::Device& device, Registry registry)
    : device_(device), registry_(std::move(registry)), state_(std::make_unique<State>()) {
  gl::ShaderFiles& files = device_.shaders.files();
  files.put("generated/params.glsl", glsl_declarations(ParamSet(registry_.params()), block_params));
  for (const Technique& technique : registry_.techniques()) put_drivers(files, technique);
}

SoftShadows::~SoftShadows() = default;

LightFrame SoftShadows::prepare_light(const Inputs& inputs, const Light& light, const ParamSet& params, int layer) {
  const Technique& technique = registry_.find(params.get_word("technique"));
  LightFrame frame;
  frame.layer = layer;
  frame.tan_half_angle = std::tan(glm::radians(params.get_float("sun.angle")) * 0.5f);
  frame.cascades = light.maps ? light.maps->cascades
                              : fit_cascades({.view = inputs.view.view,
                                              .projection = inputs.view.projection,
                                              .to_light = light.to_light,
                                              .tan_half_angle = frame.tan_half_angle,
                                              .casters = inputs.casters,
                                              .receivers = inputs.receivers,
                                              .count = params.get_int("cascades.count"),
                                              .size = params.get_int("cascades.size"),
                                              .split_blend = params.get_float("cascades.split"),
                                              .distance = params.get_float("cascades.distance")});
  if ((technique.needs & (needs_shadow_map | needs_depth_pyramid)) != 0) {
    frame.depth = light.maps ? light.maps->depth.id
                             : draw_shadow_map(device_, {.name = fmt::format("shadow map {}", light.id),
                                                         .cascades = frame.cascades,
                                                         .draw = inputs.draw})
                                   .id();
  }
  if ((technique.needs & needs_depth_pyramid) != 0) {
    frame.pyramid = &build_depth_pyramid(device_, {.name = fmt::format("depth pyramid {}", light.id),
                                                   .depth = frame.depth,
                                                   .size = frame.cascades.size,
                                                   .layers = static_cast<int>(frame.cascades.items.size())});
  }
  if (technique.prepare) technique.prepare(device_, frame, params);
  return frame;
}

void SoftShadows::bind_light(const LightFrame& light, size_t index) {
  const State::PerLight& own = state_->lights[index];
  for (const GLuint block : {block_params, block_shadow, block_samples}) own.blocks[block]->bind_uniform(block);
  // Beyond a map there is nothing, which is at depth 1.
  device_.sampler({.wrap_s = GL_CLAMP_TO_BORDER, .wrap_t = GL_CLAMP_TO_BORDER}).bind(unit_depth);
  device_.sampler({}).bind(unit_pyramid);
  gl::glBindTextureUnit(unit_depth, light.depth);
  gl::glBindTextureUnit(unit_pyramid, light.pyramid != nullptr ? light.pyramid->id() : 0);
}

void SoftShadows::upload_light(const Inputs& inputs, const LightFrame& light, size_t index) {
  State::PerLight& own = state_->lights[index];
  const bool square = own.params.get_word("sun.shape") == "square";
  const std::vector<std::byte> params = uniform_bytes(own.params);
  const gl::Buffer& params_buffer = device_.scratch(fmt::format("shadow params {}", index), params.size());
  const gl::Buffer& shadow_buffer = device_.scratch(fmt::format("shadow block {}", index), sizeof(glsl::ShadowBlock));
  const gl::Buffer& sample_buffer = device_.scratch(fmt::format("shadow samples {}", index), sizeof(glsl::SampleBlock));
  params_buffer.write(params);
  gl::write_value(shadow_buffer, shadow_block(inputs, light, square));
  gl::write_value(sample_buffer, own.sampling.points);
  own.blocks[block_params] = &params_buffer;
  own.blocks[block_shadow] = &shadow_buffer;
  own.blocks[block_samples] = &sample_buffer;
}

void SoftShadows::draw_mask(const Inputs& inputs, const LightFrame& light, size_t index, const gl::Texture& mask) {
  const State::PerLight& own = state_->lights[index];
  const Technique& technique = registry_.find(own.params.get_word("technique"));
  if (technique.resolve) {
    technique.resolve({device_, light, own.params, inputs.depth.id, inputs.normals.id, mask});
    return;
  }
  const bool compute = own.params.get_word("driver") == "compute";
  gl::PassDesc desc{.name = "shadow mask"};
  if (!compute) desc.colors = {{.texture = &mask, .layer = light.layer}};
  gl::Pass pass(device_, desc);
  const gl::Program& program = pass.use(mask_program(technique, own.params, own.sampling.rotated, compute));
  bind_light(light, index);
  for (const GLuint unit : {unit_receiver_depth, unit_receiver_normal}) device_.sampler({}).bind(unit);
  gl::glBindTextureUnit(unit_receiver_depth, inputs.depth.id);
  gl::glBindTextureUnit(unit_receiver_normal, inputs.normals.id);
  if (compute) {
    program.set("mask_layer", light.layer);
    mask.bind_image(0, GL_WRITE_ONLY);
    pass.dispatch(inputs.depth.width, inputs.depth.height);
  } else {
    pass.draw_full_screen();
  }
}

Mask SoftShadows::render(const Inputs& inputs, const ParamSet& params) {
  check(inputs);
  Mask mask;
  mask.texture = &device_.target("shadow mask", {.target = GL_TEXTURE_2D_ARRAY,
                                                 .format = GL_RGBA16F,
                                                 .width = inputs.depth.width,
                                                 .height = inputs.depth.height,
                                                 .layers = std::max(1, static_cast<int>(inputs.lights.size()))});
  state_->lights.resize(inputs.lights.size());
  for (size_t i = 0; i < inputs.lights.size(); ++i) {
    State::PerLight& own = state_->lights[i];
    own.params = params_of(registry_, params, inputs.lights[i]);
    own.sampling = sampling_of(registry_.find(own.params.get_word("technique")), own.params);
    const LightFrame light = prepare_light(inputs, inputs.lights[i], own.params, static_cast<int>(i));
    upload_light(inputs, light, i);
    draw_mask(inputs, light, i, *mask.texture);
    mask.lights.push_back(light);
  }
  return mask;
}

std::vector<gl::Define> SoftShadows::bind_forward(const Mask& mask, size_t light) {
  bind_light(mask.lights.at(light), light);
  const State::PerLight& own = state_->lights[light];
  return technique_defines(forward_technique(own.params), own.params, own.sampling.rotated);
}

const Technique& SoftShadows::forward_technique(const ParamSet& params) const {
  const Technique& technique = registry_.find(params.get_word("technique"));
  return technique.stand_in.empty() ? technique : registry_.find(technique.stand_in);
}

std::string SoftShadows::forward_include(const ParamSet& params) const {
  return generated(forward_technique(params), "forward.glsl");
}

std::vector<gl::ProgramDesc> SoftShadows::all_programs(const ParamSet& defaults) const {
  std::vector<gl::ProgramDesc> programs{depth_pyramid_program(true), depth_pyramid_program(false)};
  for (const Technique& technique : registry_.techniques()) {
    if (technique.resolve) continue;
    for (const ParamSet& params : compiled_variants(technique, defaults)) {
      for (const bool compute : {false, true}) {
        for (const bool rotated : {true, false}) programs.push_back(mask_program(technique, params, rotated, compute));
      }
    }
  }
  return programs;
}

}  // namespace penumbra::shadow

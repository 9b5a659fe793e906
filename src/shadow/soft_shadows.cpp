#include "soft_shadows.h"

#include <algorithm>
#include <atomic>
#include <map>

#include "../core/error.h"
#include "denoise.h"
#include "forward_source.h"
#include "light_block.h"
#include "light_maps.h"
#include "light_state.h"
#include "programs.h"
#include "samples.h"

namespace penumbra::shadow {

namespace {

// The library's rows alone, in the order that GLSL was told of, with the caller's values and the light's own.
ParamSet params_of(const Registry& registry, const ParamSet& params, const Light& light) {
  ParamSet own(registry.params());
  for (const std::string& name : own.names()) own.set(name, params.value(name));
  for (const std::string& assignment : light.overrides) own.assign(assignment);
  return own;
}

int next_number() {
  static std::atomic<int> last{0};
  return ++last;
}

}  // namespace

struct SoftShadows::State {
  State(gl::Device& device, const Registry& registry)
      : programs(device, registry), samples(device, fmt::format("shadow {}/", number)) {}

  const int number = next_number();  // tells the facades of a device apart
  Programs programs;
  Samples samples;
  std::map<int, ViewState> views;
};

SoftShadows::SoftShadows(gl::Device& device, Registry registry)
    : device_(device), registry_(std::move(registry)), state_(std::make_unique<State>(device, registry_)) {}

SoftShadows::~SoftShadows() { device_.drop(fmt::format("shadow {}/", state_->number)); }

std::string SoftShadows::view_prefix(int id) const { return fmt::format("shadow {}/view {}/", state_->number, id); }

void SoftShadows::upload_blocks(const Technique& technique, const Inputs& inputs, const LightFrame& frame,
                                const std::string& prefix, LightState& state) {
  const std::vector<std::byte> params = uniform_bytes(state.params);
  const int age = static_cast<int>(state.age);
  state.rotated = turns_samples(technique, state.params);
  state.noise = &state_->samples.noise(state.params.get_word("sampling.noise"));
  state.params_block = &device_.scratch(prefix + "params", params.size());
  state.shadow_block = &device_.scratch(prefix + "light", sizeof(glsl::ShadowBlock));
  state.sample_block = &device_.scratch(prefix + "samples", sizeof(glsl::SampleBlock));
  state.params_block->write(params);
  const LightTraits traits{.noise_shift = noise_shift(state.params, age),
                           .last_jitter = state_->views[frame.view].last_jitter};
  gl::write_value(*state.shadow_block, shadow_block(inputs, frame, traits));
  gl::write_value(*state.sample_block, state_->samples.block(technique, state.params, age));
}

// What forward surfaces read instead of the technique's own: made by the stand-in, in a state of its own.
void SoftShadows::prepare_stand_in(const Inputs& inputs, const Light& light, const std::string& light_prefix,
                                   LightFrame& frame, LightState& of_light, const gl::Texture& mask) {
  const std::string prefix = light_prefix + "stand-in/";
  const Technique& technique = forward_technique(of_light.params);
  if (technique.name == of_light.params.get_word("technique")) {
    if (of_light.stand_in) device_.drop(prefix);
    of_light.stand_in.reset();
    return;
  }
  frame.products.clear();
  if (!of_light.stand_in) of_light.stand_in = std::make_unique<LightState>();
  LightState& state = *of_light.stand_in;
  state.goes_on = of_light.goes_on;
  begin_frame(state, technique, light, frame, of_light.params);
  upload_blocks(technique, inputs, frame, prefix, state);
  if (technique.prepare) {
    technique.prepare(
        TechniqueFrame({device_, state_->programs, technique, inputs, light, mask, frame, state, prefix}));
  }
  drop_unused_rings(state, device_, prefix);
}

LightFrame SoftShadows::render_light(const Inputs& inputs, const Light& light, ParamSet params, LightState& state,
                                     const gl::Texture& mask, int layer) {
  const std::string prefix = fmt::format("{}light {}/", view_prefix(inputs.view.id), light.id);
  const Technique& technique = registry_.find(params.get_word("technique"));
  LightFrame frame{.view = inputs.view.id,
                   .light = light.id,
                   .layer = layer,
                   .viewport = viewport_of(inputs),
                   .projection = projection_of(inputs, light, params),
                   .shape = shape_of(light.source, params)};
  begin_frame(state, technique, light, frame, std::move(params));
  const unsigned needs = technique.needs | forward_technique(state.params).needs;
  make_maps(device_, {.inputs = inputs, .light = light, .state = state, .needs = needs, .prefix = prefix}, frame);
  upload_blocks(technique, inputs, frame, prefix, state);

  const LibraryFrame work({device_, state_->programs, technique, inputs, light, mask, frame, state, prefix});
  if (technique.prepare) technique.prepare(work);
  if (technique.resolve) {
    device_.drop(prefix + "denoise/");
    technique.resolve(work);
  } else if (is_denoised(state.params)) {
    frame.notes = &draw_denoised(work, registry_);
  } else {
    device_.drop(prefix + "denoise/");
    work.evaluate(mask, layer);
  }
  drop_unused_rings(state, device_, prefix);
  prepare_stand_in(inputs, light, prefix, frame, state, mask);
  state.drawn = true;
  return frame;
}

Mask SoftShadows::render(const Inputs& inputs, const ParamSet& params) {
  check(inputs);
  ViewState& view = state_->views[inputs.view.id];
  begin_frame(view, inputs);
  Mask mask;
  mask.texture = &device_.target(view_prefix(inputs.view.id) + "mask",
                                 {.target = GL_TEXTURE_2D_ARRAY,
                                  .format = GL_RGBA16F,
                                  .width = inputs.depth.width,
                                  .height = inputs.depth.height,
                                  .layers = std::max(1, static_cast<int>(inputs.lights.size()))});
  for (const Light& light : inputs.lights) {
    mask.lights.push_back(render_light(inputs, light, params_of(registry_, params, light), view.lights[light.id],
                                       *mask.texture, static_cast<int>(mask.lights.size())));
  }
  std::erase_if(view.lights, [&](const auto& entry) {
    if (!entry.second.drawn) device_.drop(fmt::format("{}light {}/", view_prefix(inputs.view.id), entry.first));
    return !entry.second.drawn;
  });
  view.drawn = true;
  gl::leave_initial_state();
  return mask;
}

void SoftShadows::forget_view(int id) {
  state_->views.erase(id);
  device_.drop(view_prefix(id));
}

void SoftShadows::bind_forward(const Mask& mask, size_t light) {
  const LightFrame& frame = mask.lights.at(light);
  const LightState& state = state_->views.at(frame.view).lights.at(frame.light);
  bind_light(device_, frame, state.stand_in ? *state.stand_in : state);
}

void SoftShadows::unbind_forward() { gl::unbind_textures(first_pass_unit); }

const Technique& SoftShadows::forward_technique(const ParamSet& params) const {
  const Technique& technique = registry_.find(params.get_word("technique"));
  return technique.stand_in.empty() ? technique : registry_.find(technique.stand_in);
}

ForwardProgram SoftShadows::forward_program(const ParamSet& params, const Light& light) const {
  const ParamSet own = params_of(registry_, params, light);
  const Technique& technique = forward_technique(own);
  return {state_->programs.forward_file(technique), Programs::defines(technique, own, turns_samples(technique, own))};
}

std::string SoftShadows::forward_source(const ParamSet& params, const Light& light) const {
  const ForwardProgram program = forward_program(params, light);
  const gl::ShaderSource source = gl::load_shader_source(device_.shaders.files(), program.include, program.defines);
  return with_prefix(without_version(source.text), "penumbra_");
}

std::vector<gl::ProgramDesc> SoftShadows::all_programs(const ParamSet& defaults) const {
  return state_->programs.all(defaults);
}

std::vector<ForwardProgram> SoftShadows::all_forward_programs(const ParamSet& defaults) const {
  std::vector<ForwardProgram> all;
  for (const Technique& technique : registry_.techniques()) {
    if (technique.glsl.empty()) continue;
    for (std::vector<gl::Define>& defines : state_->programs.all_defines(technique, defaults)) {
      all.push_back({state_->programs.forward_file(technique), std::move(defines)});
    }
  }
  return all;
}

}  // namespace penumbra::shadow

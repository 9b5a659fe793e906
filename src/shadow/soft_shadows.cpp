#include "soft_shadows.h"

#include <fmt/format.h>

#include <atomic>
#include <map>

#include "forward_source.h"
#include "frame.h"

namespace penumbra::shadow {

namespace {

int next_number() {
  static std::atomic<int> last{0};
  return ++last;
}

}  // namespace

struct SoftShadows::State {
  State(gl::Device& device, const Registry& registry)
      : defaults(registry.params()), programs(device, registry), samples(device, fmt::format("shadow {}/", number)) {}

  // The library's rows alone, in the order that GLSL was told of, with the caller's values and the light's own.
  // Until it is asked for others.
  const ParamSet& params_of(const ParamSet& params, const Light& light) {
    take_params(forward, defaults, params, light);
    return forward.params;
  }

  const int number = next_number();  // unique for each SoftShadows object of a device
  const ParamSet defaults;
  Programs programs;
  Samples samples;
  std::map<int, ViewState> views;
  LightState forward;  // the parameters of the last forward program that was requested
};

SoftShadows::SoftShadows(gl::Device& device, Registry registry)
    : device_(device), registry_(std::move(registry)), state_(std::make_unique<State>(device, registry_)) {}

SoftShadows::~SoftShadows() { device_.drop(fmt::format("shadow {}/", state_->number)); }

std::string SoftShadows::view_prefix(int id) const { return fmt::format("shadow {}/view {}/", state_->number, id); }

Mask SoftShadows::render(const Inputs& inputs, const ParamSet& params) {
  ViewState& view = state_->views[inputs.view.id];
  if (view.prefix.empty()) view.prefix = view_prefix(inputs.view.id);
  return draw_mask({.device = device_,
                    .registry = registry_,
                    .programs = state_->programs,
                    .samples = state_->samples,
                    .defaults = state_->defaults,
                    .inputs = inputs,
                    .params = params},
                   view);
}

void SoftShadows::forget_view(int id) {
  state_->views.erase(id);
  device_.drop(view_prefix(id));
}

void SoftShadows::bind_forward(const Mask& mask, size_t light) {
  const LightFrame& frame = mask.lights.at(light);
  const LightState& state = state_->views.at(frame.view).lights.at(frame.light);
  bind_light(device_, frame, state, owner_of(forward_technique(registry_, state.params)));
}

void SoftShadows::unbind_forward() { gl::unbind_textures(first_pass_unit); }

ForwardProgram SoftShadows::forward_program(const ParamSet& params, const Light& light) const {
  const ParamSet& own = state_->params_of(params, light);
  const Technique& technique = forward_technique(registry_, own);
  return {state_->programs.forward_file(technique), Programs::defines(technique, own, rotates_samples(technique, own))};
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

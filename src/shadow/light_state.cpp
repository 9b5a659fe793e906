#include "light_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace penumbra::shadow {

namespace {

// Whether two matrices are equal up to rounding, since the caller may have computed them again.
bool same_matrix(const glm::mat4& a, const glm::mat4& b) {
  constexpr float rounding = 1e-5f;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      const float x = a[column][row];
      const float y = b[column][row];
      if (!(std::abs(x - y) <= rounding * std::max({1.0f, std::abs(x), std::abs(y)}))) return false;
    }
  }
  return true;
}

// Whether the parameter belongs to a technique or denoiser that is not the chosen one.
bool is_of_other(const std::string& name, const ParamSet& params, const char* choice) {
  const std::string owner = name.substr(0, name.find('.'));
  const std::vector<std::string>& choices = params.row(choice).choices;
  return owner != params.get_word(choice) && std::ranges::find(choices, owner) != choices.end();
}

// Whether all parameters that the technique and the denoiser can read are the same.
bool same_values(const ParamSet& a, const ParamSet& b) {
  if (!a.contains("technique")) return false;
  return std::ranges::all_of(b.rows(), [&](const Param& row) {
    return a.value(row.name) == b.value(row.name) || is_of_other(row.name, b, "technique") ||
           is_of_other(row.name, b, "denoiser");
  });
}

bool same_conventions(const Conventions& a, const Conventions& b) {
  return a.reversed_z == b.reversed_z && a.depth_zero_to_one == b.depth_zero_to_one &&
         a.octahedral_normals == b.octahedral_normals;
}

bool continues(const ViewState& last, const Inputs& inputs) {
  return last.drawn && !inputs.view.cut && same_matrix(last.view, inputs.view.last_view) &&
         same_matrix(last.projection, inputs.view.last_projection) && last.width == inputs.depth.width &&
         last.height == inputs.depth.height && last.viewport == viewport_of(inputs) &&
         same_conventions(last.conventions, inputs.conventions);
}

}  // namespace

void begin_frame(ViewState& view, const Inputs& inputs) {
  const bool uninterrupted = continues(view, inputs);
  for (auto& [id, light] : view.lights) {
    light.uninterrupted = uninterrupted && light.drawn;
    light.drawn = false;
  }
  view.last_jitter = view.jitter;
  view.jitter = inputs.view.jitter;
  view.view = inputs.view.view;
  view.projection = inputs.view.projection;
  view.conventions = inputs.conventions;
  view.width = inputs.depth.width;
  view.height = inputs.depth.height;
  view.viewport = viewport_of(inputs);
  view.drawn = false;  // until the end: after a frame that throws nothing is kept
}

bool take_params(LightState& state, const ParamSet& defaults, const ParamSet& given, const Light& light) {
  const bool first = !state.params.contains("technique");
  if (!first && state.given == given && state.overrides == light.overrides) return true;
  ParamSet own = defaults;
  for (const Param& row : own.rows()) own.set(row.name, given.value(row.name));
  for (const std::string& assignment : light.overrides) own.assign(assignment);
  const bool same = same_values(state.params, own);
  state.given = given;
  state.overrides = light.overrides;
  state.params = std::move(own);
  state.programs.clear();
  state.samples.clear();
  state.uploaded = false;
  return same;
}

void begin_frame(LightState& state, const Light& light, int layers, bool same_params) {
  const bool holds = state.uninterrupted && same_params && state.source == light.source && state.layers == layers;
  state.age = holds ? state.age + 1 : 0;
  ++state.frames;
  state.source = light.source;
  state.layers = layers;
}

std::string kept_prefix(std::string_view name) { return fmt::format("history {}/", name); }

std::string product_prefix(std::string_view recipe) { return fmt::format("products/{}/", recipe); }

}  // namespace penumbra::shadow

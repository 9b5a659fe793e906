#include "light_state.h"

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

// Whether all parameters that concern the technique and the denoiser are the same. maps.keep changes no picture.
bool same_values(const Registry& registry, const ParamSet& a, const ParamSet& b) {
  if (!a.contains("technique")) return false;
  return std::ranges::all_of(b.rows(), [&](const Param& row) {
    return a.value(row.name) == b.value(row.name) || row.name == "maps.keep" || !registry.concerns(row.name, b);
  });
}

bool same_conventions(const Conventions& a, const Conventions& b) {
  return a.reversed_z == b.reversed_z && a.depth_zero_to_one == b.depth_zero_to_one &&
         a.octahedral_normals == b.octahedral_normals && a.normals_scale == b.normals_scale &&
         a.normals_offset == b.normals_offset && a.shading_normals == b.shading_normals;
}

// Whether this is the next frame of the same scene, so that the caller's account of what moved starts at the last one.
bool follows(const ViewState& last, const Inputs& inputs) {
  return !inputs.view.cut && same_matrix(last.view, inputs.view.last_view) &&
         same_matrix(last.projection, inputs.view.last_projection);
}

// Whether the pixels of the last frame can be found in this one.
bool same_pixels(const ViewState& last, const Inputs& inputs) {
  return last.width == inputs.depth.width && last.height == inputs.depth.height &&
         last.viewport == viewport_of(inputs) && last.brings_normals == !inputs.makes_normals() &&
         same_conventions(last.conventions, inputs.conventions);
}

}  // namespace

void begin_frame(ViewState& view, const Inputs& inputs, bool last_completed) {
  const bool is_next = last_completed && follows(view, inputs);
  const bool uninterrupted = is_next && !inputs.view.restart && same_pixels(view, inputs);
  for (auto& [id, light] : view.lights) {
    light.uninterrupted = uninterrupted && light.drawn;
    light.follows = is_next && light.drawn;
    light.drawn = false;
  }
  view.rests = inputs.view.view == inputs.view.last_view && inputs.view.projection == inputs.view.last_projection;
  view.last_jitter = view.jitter;
  view.jitter = inputs.view.jitter;
  view.view = inputs.view.view;
  view.projection = inputs.view.projection;
  view.conventions = inputs.conventions;
  view.width = inputs.depth.width;
  view.height = inputs.depth.height;
  view.viewport = viewport_of(inputs);
  view.brings_normals = !inputs.makes_normals();
}

bool take_params(LightState& state, const GivenParams& given, const Light& light) {
  const bool first = !state.params.contains("technique");
  if (!first && state.given == given.values && state.overrides == light.overrides) return true;
  ParamSet own = given.defaults;
  for (const Param& row : own.rows()) own.set(row.name, given.values.value(row.name));
  for (const std::string& assignment : light.overrides) own.assign(assignment);
  if (!first) take_layers(state, /*second_layer=*/true);
  const bool same = same_values(given.registry, state.params, own);
  state.given = given.values;
  state.overrides = light.overrides;
  state.params = std::move(own);
  state.asked_layers = state.params.contains("maps.layers") ? state.params.get_int("maps.layers") : 1;
  state.programs.clear();
  state.samples.clear();
  if (!same) state.drawn_texels.reset();
  state.uploaded = false;
  state.changed = true;
  return same;
}

void take_layers(LightState& state, bool second_layer) {
  const int layers = second_layer ? state.asked_layers : 1;
  // Registries without a second layer have no such parameter.
  if (!state.params.contains("maps.layers") || state.params.get_int("maps.layers") == layers) return;
  state.params.set("maps.layers", layers);
  state.programs.clear();
  state.changed = true;
}

void take_shape(LightState& state, const LightShape& shape) {
  if (state.shape == shape) return;
  state.shape = shape;
  state.programs.clear();
}

void begin_frame(const ViewState& view, LightState& state, const Light& light, int layers, bool same_params) {
  const bool holds = state.uninterrupted && same_params && state.source == light.source && state.layers == layers;
  state.age = holds ? state.age + 1 : 0;
  state.rests = holds ? state.rests + (view.rests ? 1 : 0) : 0;
  ++state.frames;
  state.source = light.source;
  state.layers = layers;
}

}  // namespace penumbra::shadow

#include "light_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace penumbra::shadow {

namespace {

// Matrices that a caller has stored or made again: equal but for rounding.
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

// Whether all that a technique can see is the same: its choice, the library's rows and its own.
bool same_values(const Technique& technique, const ParamSet& a, const ParamSet& b) {
  if (!a.contains("technique")) return false;
  const std::vector<std::string>& techniques = b.row("technique").choices;
  return std::ranges::all_of(b.rows(), [&](const Param& row) {
    const std::string owner = row.name.substr(0, row.name.find('.'));
    const bool of_another = owner != technique.name && std::ranges::find(techniques, owner) != techniques.end();
    return of_another || a.value(row.name) == b.value(row.name);
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
  const bool goes_on = continues(view, inputs);
  for (auto& [id, light] : view.lights) {
    light.goes_on = goes_on && light.drawn;
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
  view.drawn = false;  // until the end: a frame that throws leaves nothing to go on from
}

void begin_frame(LightState& state, const Technique& technique, const Light& light, const LightFrame& frame,
                 ParamSet params) {
  const bool goes_on = state.goes_on && state.source == light.source && state.layers == frame.projection.layers() &&
                       same_values(technique, state.params, params);
  state.age = goes_on ? state.age + 1 : 0;
  ++state.frames;
  state.source = light.source;
  state.layers = frame.projection.layers();
  state.params = std::move(params);
}

std::string ring_prefix(std::string_view name) { return fmt::format("history {}/", name); }

void drop_unused_rings(LightState& state, gl::Device& device, const std::string& prefix) {
  std::erase_if(state.rings, [&](const auto& entry) {
    const bool unused = entry.second.filled != state.frames;
    if (unused) device.drop(prefix + ring_prefix(entry.first));
    return unused;
  });
}

void bind_light(gl::Device& device, const LightFrame& frame, const LightState& state) {
  state.params_block->bind_uniform(block_params);
  state.shadow_block->bind_uniform(block_shadow);
  state.sample_block->bind_uniform(block_samples);
  // Beyond a map there is nothing, which is at depth 1.
  device.sampler({.wrap_s = GL_CLAMP_TO_BORDER, .wrap_t = GL_CLAMP_TO_BORDER}).bind(unit_shadow_map);
  gl::glBindTextureUnit(unit_shadow_map, frame.depth);
  device.sampler({}).bind(unit_depth_pyramid);
  gl::glBindTextureUnit(unit_depth_pyramid, frame.pyramid != nullptr ? frame.pyramid->id() : 0);
  device.sampler({}).bind(unit_noise);
  state.noise->bind(unit_noise);
  for (const Product& product : frame.products) {
    device.sampler(product.sampler).bind(product.unit);
    product.texture->bind(product.unit);
  }
}

}  // namespace penumbra::shadow

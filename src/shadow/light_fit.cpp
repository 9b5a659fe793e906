#include "light_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "../core/error.h"
#include "movement_map.h"
#include "sampling.h"

namespace penumbra::shadow {

namespace {

// See CascadeInputs.
double nearest_of(const glm::mat4& projection, const Conventions& conventions) {
  if (projection[2][3] != 0) return 0;
  const double at_near = conventions.reversed_z ? 1 : conventions.depth_zero_to_one ? 0 : -1;
  const glm::dmat4 to_view = glm::inverse(glm::dmat4(projection));
  double nearest = 0;  // an oblique near plane is nearer in some corners
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      const glm::dvec4 corner = to_view * glm::dvec4(x, y, at_near, 1);
      nearest = std::min(nearest, -corner.z / corner.w);
    }
  }
  return nearest;
}

FitInputs fit_inputs(const Inputs& inputs, const ParamSet& params) {
  return {.view = inputs.view.view,
          .projection = inputs.view.projection,
          .nearest = nearest_of(inputs.view.projection, inputs.conventions),
          .casters = inputs.casters,
          .receivers = inputs.receivers,
          .exact_bounds = inputs.exact_bounds,
          .params = params};
}

// Whether all that reads the light's maps reads them only near receivers of the view.
bool reads_light_discs(const LightWork& work, const std::vector<const Recipe*>& recipes) {
  const bool denoiser_reads_maps =
      work.denoiser != nullptr && std::ranges::find(work.denoiser->needs, "shadow_map") != work.denoiser->needs.end();
  return work.technique.reads_light_discs && work.forward.reads_light_discs && !denoiser_reads_maps &&
         std::ranges::all_of(recipes, &Recipe::reads_light_discs);
}

// Whether a history averages maps. Surfaces that are drawn forward read the frame's maps without one.
bool adds_up_maps(const LightWork& work) {
  const Box& forward = work.inputs.forward_receivers;
  const bool has_forward = glm::all(glm::lessThanEqual(forward.min, forward.max));
  return !work.remembered.empty() && !has_forward;
}

bool is_for(const LightState::DrawnTexels& drawn, const LightWork& work, const ReadBounds& read) {
  const Inputs& inputs = work.inputs;
  return drawn.view == inputs.view.view && drawn.projection == inputs.view.projection &&
         drawn.casters == inputs.casters && drawn.receivers == inputs.receivers &&
         drawn.exact_bounds == inputs.exact_bounds && drawn.source == work.light.source &&
         drawn.jitter == map_jitter(work) && drawn.read == read;
}

}  // namespace

glm::dvec2 map_jitter(const LightWork& work) {
  if (!work.params().get_bool("maps.jitter")) return glm::dvec2(0);
  const auto number = static_cast<unsigned>(adds_up_maps(work) ? work.state.rests : 0);
  constexpr double root = 1.32471795724474602596;  // of x³ = x + 1
  const double seed = work.params().get_int("sampling.seed");
  const glm::dvec2 shift = seed * glm::dvec2(1 / root, 1 / (root * root));
  return glm::fract(glm::dvec2(radical_inverse(2, number), radical_inverse(3, number)) + shift);
}

bool moves_maps(const LightWork& work) {
  if (work.light.maps || work.frame.shape.lamp || !work.params().get_bool("maps.jitter")) return false;
  if (adds_up_maps(work)) return work.view.rests && work.state.rests > 0;
  // Samples of one picture differ by their seeds.
  return work.remembered.empty() && work.params().get_int("sampling.seed") != 0;
}

namespace {

void check_fits(const LightWork& work, const LightProjection& projection) {
  const std::string fault = projection.fault();
  if (fault.empty()) return;
  const bool fitted_to_bounds = !work.light.maps && !work.frame.shape.lamp;
  const char* cause = fitted_to_bounds ? "; casters, receivers and camera may be too far from each other" : "";
  fail("soft shadows: no maps of light {} fit the view: {}{}", work.light.id, fault, cause);
}

}  // namespace

LightProjection projection_of(const LightWork& work, const ShownReceivers& shown,
                              const std::vector<const Recipe*>& recipes) {
  if (work.light.maps) {
    check_fits(work, work.light.maps->projection);
    return work.light.maps->projection;
  }
  FitInputs fit = fit_inputs(work.inputs, work.params());
  fit.visible = shown.visible;
  fit.near_penumbrae = shown.near_penumbrae;
  fit.others = work.inputs.forward_receivers;
  fit.jitter = map_jitter(work);
  fit.divides_texels = reads_light_discs(work, recipes);
  LightProjection projection = fit_projection(work.light.source, fit);
  check_fits(work, projection);
  return projection;
}

int layer_count(const Light& light, const ParamSet& params) {
  if (light.maps) return light.maps->projection.layers();
  const int of_lamp = lamp_map_count(light.source);
  return of_lamp > 0 ? of_lamp : params.get_int("cascades.count");
}

std::string bounds_warning(const CutOff& cut_off) {
  if (!cut_off.view && !cut_off.light) return "";
  std::string cut;
  if (cut_off.view) cut = fmt::format("receivers more than {} km from the camera are lit", range_in_wide_bounds / 1000);
  if (cut_off.light) {
    cut += fmt::format("{}casters more than {} km before the receivers along the light cast no shadow",
                       cut.empty() ? "" : ", and ", wide_bounds / 1000);
  }
  return fmt::format(
      "soft shadows: the bounding boxes of casters and receivers are wide: {}. Give the boxes of what is there, in "
      "metres, and the range of shadows as cascades.distance; or say that the bounds are exact",
      cut);
}

void narrow_projection(const LightWork& work, const std::vector<const Recipe*>& recipes) {
  if (work.light.maps || !reads_light_discs(work, recipes)) return;
  const Inputs& inputs = work.inputs;
  ReadBounds read{.jitter = inputs.view.jitter, .moved = {}};
  if (!work.remembered.empty() && !nothing_moved(inputs.moved)) read.moved = inputs.moved;
  LightProjection& projection = work.frame.projection;
  std::optional<LightState::DrawnTexels>& last = work.state.drawn_texels;
  if (!last || !is_for(*last, work, read)) {
    last = {.view = inputs.view.view,
            .projection = inputs.view.projection,
            .casters = inputs.casters,
            .receivers = inputs.receivers,
            .exact_bounds = inputs.exact_bounds,
            .source = work.light.source,
            .jitter = map_jitter(work),
            .read = read,
            .of_layers = {}};
    const LightProjection limited = narrowed(projection, work.light.source, fit_inputs(inputs, work.params()), read);
    for (int i = 0; i < limited.layers(); ++i) last->of_layers[static_cast<size_t>(i)] = limited.drawn_texels(i);
  }
  for (int i = 0; i < projection.layers(); ++i) {
    projection.set_drawn_texels(i, last->of_layers[static_cast<size_t>(i)]);
  }
}

}  // namespace penumbra::shadow

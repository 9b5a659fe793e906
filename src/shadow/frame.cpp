#include "frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "../core/error.h"
#include "../core/log.h"
#include "copies.h"
#include "depth_normals.h"
#include "light_fit.h"
#include "light_maps.h"
#include "mask_layer.h"
#include "near_penumbrae.h"
#include "outputs.h"
#include "products.h"
#include "uploads.h"
#include "visible_receivers.h"

namespace penumbra::shadow {

namespace {

// Releases the maps and histories that the last frame used and this one did not, and, after a change of parameters, all
// other targets of techniques, recipes and denoisers that this frame did not use.
void release_unused(const LightWork& work, bool draws_shadow_map) {
  LightState& state = work.state;
  std::erase_if(state.kept, [&](const auto& entry) {
    const bool unused = entry.second.filled != state.frames;
    if (unused) work.device.drop(entry.first + "/");
    return unused;
  });
  const bool has_movement_map = work.frame.movement != nullptr;
  if (state.had_movement_map && !has_movement_map) work.device.drop(work.prefix() + movement_map_name);
  state.had_movement_map = has_movement_map;
  if (state.had_shadow_map && !draws_shadow_map) work.device.drop(work.prefix() + shadow_map_name);
  state.had_shadow_map = draws_shadow_map;
  if (!state.changed) return;
  for (const char* owners : {"techniques/", "recipes/", "denoisers/"}) {
    work.device.drop(work.prefix() + owners, state.used);
  }
  state.changed = false;
  state.used.clear();
}

// A light with its parameters for this frame.
struct ReadLight {
  const Light& light;
  LightState& state;
  bool same_params = false;  // see take_params()
};

ReadLight read_light(const MaskInputs& from, const Light& light, ViewState& view) {
  LightState& state = view.lights[light.id];
  if (state.prefix.empty()) state.prefix = fmt::format("{}light {}/", view.prefix, light.id);
  return {light, state,
          take_params(state, {.registry = from.registry, .defaults = from.defaults, .values = from.params}, light)};
}

// Samplers and depth tests compare the depths of a depth format alone. Copies have one.
void check_compared_maps(const Light& light, const TextureChecks& checked, const Technique& technique,
                         const ParamSet& params, const Wanted& wanted) {
  const auto compares = [&](const Recipe* recipe) {
    return recipe->sampler.compare || (recipe->tests_depths && (!recipe->applies || recipe->applies(params)));
  };
  if (std::ranges::none_of(wanted.recipes, compares) || light.maps->is_copied()) return;
  if (checked.source_of(*light.maps).can_compare) return;
  fail("soft shadows: the maps of light {} are R32F, whose depths technique '{}' can't compare: use a depth format",
       light.id, technique.name);
}

// Runs all steps for one light, from its projection to its layer of the mask.
LightFrame draw_light(const MaskInputs& from, const ReadLight& read, ViewState& view, LightFrame frame,
                      const gl::Texture& mask, ScaledViews& scaled) {
  const auto& [light, state, same_params] = read;
  const Technique& technique = from.registry.find(state.params.get_word("technique"));
  const Denoiser* denoiser = denoiser_for(from.registry, technique, state.params);
  const LightWork work{.device = from.device,
                       .registry = from.registry,
                       .programs = from.programs,
                       .samples = from.samples,
                       .inputs = from.inputs,
                       .light = light,
                       .mask = mask,
                       .view = view,
                       .state = state,
                       .frame = frame,
                       .technique = technique,
                       .forward = forward_technique(from.registry, state.params),
                       .denoiser = denoiser,
                       .remembered = remembered_by(denoiser, state.params)};
  const Wanted wanted = wanted_of(work);
  // A technique's own passes and recipes may draw casters without a shadow map, but only the movement map, which is
  // drawn with the shadow map, shows where casters moved.
  const bool may_draw_casters = technique.resolve || !wanted.recipes.empty();
  ShownReceivers shown;
  if (wanted.shadow_map || may_draw_casters) {
    shown.visible = find_visible_receivers(from.device, from.inputs, light, state.params, state.prefix);
  }
  begin_frame(view, state, light, layer_count(light, state.params), same_params);
  if (std::exchange(state.bound_forward, frame.binds_forward) != frame.binds_forward) state.changed = true;
  frame.shape = shape_of(light.source, state.params);
  const NearPenumbrae near = find_near_penumbrae(work, shown.visible, wanted.recipes, view);
  shown.near_penumbrae = near.receivers;
  const bool by_overlap = state.params.contains("maps.overlap") && state.params.get_float("maps.overlap") > 0;
  take_layers(state, near.wide_overlap || !by_overlap || frame.binds_forward);
  frame.projection = projection_of(work, shown, wanted.recipes);
  if (frame.shape.lamp && technique.suns_only) {
    fail("soft shadows: light {} is a lamp, and technique '{}' is for suns alone", light.id, technique.name);
  }
  if (frame.shape.square && light.maps && std::abs(std::sin(2 * frame.projection.cascades().turn)) > 1e-3) {
    fail("soft shadows: the maps of light {} are turned about its rays, which a square sun does not allow", light.id);
  }
  if (light.maps) check_compared_maps(light, view.checked, technique, state.params, wanted);
  take_shape(state, frame.shape);
  // Whether anything is visible, and so what the maps are fitted to, may change though nothing else does.
  if (fits_to_view(state.params)) state.drawn_texels.reset();
  narrow_projection(work, wanted.recipes);
  const bool has_shadow_map = wanted.shadow_map || (may_draw_casters && asks_for_movement(work));
  plan_history(work, has_shadow_map);
  if (!has_shadow_map || light.maps) state.map = {};
  if (has_shadow_map) draw_maps(work);
  upload_blocks(work);
  make_normals(work, view);
  build_products(work, wanted.recipes);
  draw_layer(work, scaled);
  release_unused(work, has_shadow_map && (!light.maps || light.maps->is_copied()));
  state.drawn = true;
  return frame;
}

// Techniques with passes of their own may write all channels as an image, and denoisers read them from the mask.
bool has_details(const MaskInputs& from, const std::vector<ReadLight>& lights) {
  return from.inputs.mask_details || std::ranges::any_of(lights, [&](const ReadLight& light) {
           return static_cast<bool>(from.registry.find(light.state.params.get_word("technique")).resolve);
         });
}

const gl::Texture& mask_target(const MaskInputs& from, const ViewState& view, GLenum format) {
  return from.device.target(view.prefix + "mask", {.target = GL_TEXTURE_2D_ARRAY,
                                                   .format = format,
                                                   .width = from.inputs.depth.width,
                                                   .height = from.inputs.depth.height,
                                                   .layers = std::max(1, static_cast<int>(from.inputs.lights.size()))});
}

void forget_lights_left_out(gl::Device& device, ViewState& view) {
  std::erase_if(view.lights, [&](const auto& entry) {
    if (!entry.second.drawn) device.drop(entry.second.prefix);
    return !entry.second.drawn;
  });
}

// How imprecise the receivers' depths are; said once for a view if it costs shadows.
void find_depth_error(ViewState& view, const Inputs& inputs) {
  view.depth_error = ndc_error(view.checked.depth, inputs.conventions, inputs.view.projection);
  if (view.warned_of_depth) return;
  if (const std::string warning = depth_warning(inputs, view.depth_error); !warning.empty()) {
    log(LogLevel::warning, warning);
    view.warned_of_depth = true;
  }
}

// Says once for a view if its bounds are so wide that maps leave something out.
void warn_of_bounds(ViewState& view, const LightFrame& frame) {
  if (view.warned_of_bounds) return;
  if (const std::string warning = bounds_warning(frame.projection.cut_off()); !warning.empty()) {
    log(LogLevel::warning, warning);
    view.warned_of_bounds = true;
  }
}

}  // namespace

Mask draw_mask(const MaskInputs& given, ViewState& view) {
  // False until this frame is complete: after one that throws, the next has no history.
  const bool last_completed = std::exchange(view.drawn, false);
  check(given.inputs, view.checked);
  const Inputs inputs = with_copies(given.device, view, given.inputs);
  const MaskInputs from{.device = given.device,
                        .registry = given.registry,
                        .programs = given.programs,
                        .samples = given.samples,
                        .left_out = given.left_out,
                        .defaults = given.defaults,
                        .inputs = inputs,
                        .params = given.params};
  if (!from.inputs.makes_normals()) drop_normals(from.device, view);
  view.normals = nullptr;
  begin_frame(view, from.inputs, last_completed);
  find_depth_error(view, from.inputs);
  std::vector<ReadLight> lights;
  for (const Light& light : from.inputs.lights) lights.push_back(read_light(from, light, view));
  Mask mask;
  mask.texture = &mask_target(from, view, has_details(from, lights) ? GL_RGBA16F : GL_R16F);
  ScaledViews scaled;
  for (const ReadLight& read : lights) {
    const LightFrame frame{.view = from.inputs.view.id,
                           .light = read.light.id,
                           .layer = static_cast<int>(mask.lights.size()),
                           .viewport = viewport_of(from.inputs),
                           .binds_forward = from.inputs.binds_forward};
    mask.lights.push_back(draw_light(from, read, view, frame, *mask.texture, scaled));
    warn_of_bounds(view, mask.lights.back());
  }
  forget_lights_left_out(from.device, view);
  release_scales(from.device, view, scaled);
  write_outputs(from.device, from.inputs, view.checked, *mask.texture);
  from.left_out.mark_frame(from.device);
  view.drawn = true;
  gl::leave_initial_state();
  return mask;
}

}  // namespace penumbra::shadow

#include "light_maps.h"

#include <algorithm>
#include <string>
#include <vector>

#include "copies.h"
#include "movement_map.h"
#include "shadow_map.h"

namespace penumbra::shadow {

namespace {

MovementForm movement_form(const ParamSet& params) {
  return params.get_word("movement.map") == "average" ? MovementForm::average : MovementForm::maximum;
}

// Decides which layers of the shadow map still hold what they would be drawn with.
void keep_layers(const LightWork& work, const gl::Texture& map) {
  LightProjection& projection = work.frame.projection;
  MapContent& last = work.state.map;
  const MapContent now = content_of(work.device, map, projection, work.light.source);
  if (work.state.follows && work.params().get_bool("maps.keep"))
    work.frame.kept_layers = unchanged_layers(last, now, work.inputs.moved);
  for (int i = 0; i < projection.layers(); ++i) {
    const auto layer = static_cast<size_t>(i);
    if (work.frame.kept_layers[layer]) projection.set_drawn_texels(i, last.layers[layer].drawn);
  }
  last = content_of(work.device, map, projection, work.light.source);
}

}  // namespace

bool asks_for_movement(const LightWork& work) {
  const auto listed = [&] {
    const std::vector<std::string>& needs = work.denoiser->needs;
    return std::ranges::find(needs, "movement_map") != needs.end();
  };
  return !work.remembered.empty() && work.params().get_word("movement.map") != "none" && listed();
}

void plan_history(const LightWork& work, bool has_shadow_map) {
  LightFrame& frame = work.frame;
  frame.history = work.state.age > 0 && !work.remembered.empty();
  const bool asks = has_shadow_map && asks_for_movement(work);
  const bool none_moved = nothing_moved(work.inputs.moved);
  if (asks && work.inputs.draw) {
    // Allocated whether or not something moved in this frame, so that memory use stays constant.
    frame.movement = &movement_target(work.device, work.prefix() + movement_map_name, frame.projection.size(),
                                      frame.projection.layers(), movement_form(work.params()));
    frame.casters_moved = work.state.age > 0 && !none_moved;
  }
  if (asks && !work.inputs.draw && !none_moved) frame.history = false;
}

void draw_maps(const LightWork& work) {
  const Inputs& inputs = work.inputs;
  LightFrame& frame = work.frame;
  const bool finished = work.light.maps.has_value();
  const bool hidden_count = sees_hidden_casters(work.technique, work.params());
  const bool in_one_pass =
      frame.casters_moved && !finished && !hidden_count && work.params().get_word("movement.present") == "shadow_pass";
  const gl::Texture* depth = nullptr;
  if (!finished) {
    depth = &shadow_map_target(work.device, work.prefix() + shadow_map_name, frame.projection);
    keep_layers(work, *depth);
    draw_shadow_map(work.device, {.map = *depth,
                                  .projection = frame.projection,
                                  .source = work.light.source,
                                  .draw = inputs.draw,
                                  .moved = in_one_pass ? frame.movement : nullptr,
                                  .moved_bounds = inputs.moved,
                                  .kept = frame.kept_layers});
  }
  if (!finished) {
    frame.depth = depth->id();
  } else if (work.light.maps->is_copied()) {
    frame.depth = copy_maps(work.device, work.prefix() + shadow_map_name, *work.light.maps).id();
  } else {
    frame.depth = work.light.maps->depth.id;
  }
  if (!frame.casters_moved) return;
  draw_movement(work.device, {.map = *frame.movement,
                              .form = movement_form(work.params()),
                              .projection = frame.projection,
                              .source = work.light.source,
                              .draw = inputs.draw,
                              .depth = hidden_count ? nullptr : depth,
                              .moved = inputs.moved,
                              .present_is_drawn = in_one_pass});
}

}  // namespace penumbra::shadow

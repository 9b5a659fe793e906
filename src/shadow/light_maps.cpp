#include "light_maps.h"

#include "library_params.h"
#include "movement_map.h"
#include "shadow_map.h"

namespace penumbra::shadow {

namespace {

int layers_of(const LightFrame& frame) { return static_cast<int>(frame.cascades.items.size()); }

// Whether casters may have moved, where the parameters ask, and no map can show which.
bool moved_unseen(const MapsInputs& maps) {
  const bool asked = maps.state.params.get_word("movement.map") != "none";
  return asked && !maps.inputs.draw && !nothing_moved(maps.inputs.moved);
}

// The map that the parameters ask for, whether or not something moved in this frame, so that memory stays the same;
// none for a caller that has no casters to draw.
const gl::Texture* movement_map(gl::Device& device, const MapsInputs& maps, MovementForm form,
                                const LightFrame& frame) {
  const ParamSet& params = maps.state.params;
  const bool wanted = params.get_bool("history.reuse") && params.get_word("movement.map") != "none";
  if (!wanted || !maps.inputs.draw) {
    device.drop(maps.prefix + "movement map");
    return nullptr;
  }
  return &movement_target(device, maps.prefix + "movement map", frame.cascades.size, layers_of(frame), form);
}

}  // namespace

Cascades cascades_of(const Inputs& inputs, const Light& light, const ParamSet& params) {
  if (light.maps) return light.maps->cascades;
  return fit_cascades({.view = inputs.view.view,
                       .projection = inputs.view.projection,
                       .to_light = light.to_light,
                       .tan_half_angle = tan_half_angle(params),
                       .casters = inputs.casters,
                       .receivers = inputs.receivers,
                       .count = params.get_int("cascades.count"),
                       .size = params.get_int("cascades.size"),
                       .split_blend = params.get_float("cascades.split"),
                       .distance = params.get_float("cascades.distance")});
}

void make_maps(gl::Device& device, const MapsInputs& maps, LightFrame& frame) {
  frame.history = maps.state.age > 0 && maps.state.params.get_bool("history.reuse");
  if ((maps.needs & (needs_shadow_map | needs_depth_pyramid)) == 0) return;
  const Inputs& inputs = maps.inputs;
  const ParamSet& params = maps.state.params;
  const bool finished = maps.light.maps.has_value();

  const MovementForm form =
      params.get_word("movement.map") == "average" ? MovementForm::average : MovementForm::maximum;
  frame.movement = movement_map(device, maps, form, frame);
  frame.casters_moved = frame.movement != nullptr && maps.state.age > 0 && !nothing_moved(inputs.moved);
  const bool in_one_pass = frame.casters_moved && !finished && params.get_word("movement.present") == "shadow_pass";

  frame.history = frame.history && !moved_unseen(maps);

  const gl::Texture* depth = nullptr;
  if (!finished) {
    depth = &draw_shadow_map(device, {.name = maps.prefix + "shadow map",
                                      .cascades = frame.cascades,
                                      .draw = inputs.draw,
                                      .moved = in_one_pass ? frame.movement : nullptr,
                                      .moved_bounds = inputs.moved});
  }
  frame.depth = finished ? maps.light.maps->depth.id : depth->id();

  if ((maps.needs & needs_depth_pyramid) != 0) {
    frame.pyramid = &build_depth_pyramid(device, {.name = maps.prefix + "depth pyramid",
                                                  .depth = frame.depth,
                                                  .size = frame.cascades.size,
                                                  .layers = layers_of(frame)});
  }
  if (frame.casters_moved) {
    draw_movement(device, {.map = *frame.movement,
                           .form = form,
                           .cascades = frame.cascades,
                           .draw = inputs.draw,
                           .depth = depth,
                           .moved = inputs.moved,
                           .present_is_drawn = in_one_pass});
  }
}

}  // namespace penumbra::shadow

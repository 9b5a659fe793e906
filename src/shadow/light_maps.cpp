#include "light_maps.h"

#include "movement_map.h"
#include "shadow_map.h"

namespace penumbra::shadow {

namespace {

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
  return &movement_target(device, maps.prefix + "movement map", frame.projection.size(), frame.projection.layers(),
                          form);
}

}  // namespace

LightProjection projection_of(const Inputs& inputs, const Light& light, const ParamSet& params) {
  if (light.maps) return light.maps->projection;
  return fit_projection(light.source, {.view = inputs.view.view,
                                       .projection = inputs.view.projection,
                                       .casters = inputs.casters,
                                       .receivers = inputs.receivers,
                                       .params = params});
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
                                      .projection = frame.projection,
                                      .draw = inputs.draw,
                                      .moved = in_one_pass ? frame.movement : nullptr,
                                      .moved_bounds = inputs.moved});
  }
  frame.depth = finished ? maps.light.maps->depth.id : depth->id();

  if ((maps.needs & needs_depth_pyramid) != 0) {
    frame.pyramid = &build_depth_pyramid(device, {.name = maps.prefix + "depth pyramid",
                                                  .depth = frame.depth,
                                                  .size = frame.projection.size(),
                                                  .layers = frame.projection.layers()});
  }
  if (frame.casters_moved) {
    draw_movement(device, {.map = *frame.movement,
                           .form = form,
                           .projection = frame.projection,
                           .draw = inputs.draw,
                           .depth = depth,
                           .moved = inputs.moved,
                           .present_is_drawn = in_one_pass});
  }
}

}  // namespace penumbra::shadow

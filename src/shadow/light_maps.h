#pragma once

#include "light_work.h"

namespace penumbra::shadow {

constexpr const char* movement_map_name = "movement map";  // names of their targets
constexpr const char* shadow_map_name = "shadow map";

// Whether the denoiser needs a movement map, and the parameters do not turn it off.
bool asks_for_movement(const LightWork& work);

// Decides whether the history of the last frame may be used: not if casters may have moved and no movement map can show
// where.
void plan_history(const LightWork& work, bool has_shadow_map);

// Draws the shadow map, but for layers that still hold what they would be drawn with, or takes the caller's; and draws
// the movement map.
void draw_maps(const LightWork& work);

}  // namespace penumbra::shadow

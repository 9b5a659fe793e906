#pragma once

#include <span>
#include <vector>

#include "truth/light.h"
#include "truth/receiver.h"

namespace penumbra::truth {

// 1 for receivers that have the whole light above their surface, else 0: part of a light at grazing angles is below the
// surface.
std::vector<float> before_light(std::span<const Receiver> receivers, const TracedLight& light);

// The mask without occlusion: 1 where the light's centre is above the surface or there is no surface, else 0.
std::vector<float> unshadowed(std::span<const Receiver> receivers, const TracedLight& light);

}  // namespace penumbra::truth

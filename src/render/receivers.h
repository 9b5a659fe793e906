#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/renderer.h"

namespace penumbra::render {

// The receivers among the pixels of the last frame that was drawn, rows top to bottom: 1 where the whole sun could
// shine, that is geometry whose normal N_g has N_g · to_light > sin(θ / 2), else 0. `sun_angle` is θ, degrees.
std::vector<std::uint8_t> receivers_of(const Renderer& renderer, const glm::vec3& to_light, double sun_angle);

}  // namespace penumbra::render

#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/renderer.h"

namespace penumbra::render {

// Which pixels of the last frame are receivers, rows top to bottom: 1 where no part of the sun is below the surface,
// that is where there is geometry whose normal N_g has N_g · to_light > sin(θ / 2); else 0. `sun_angle` is θ, degrees.
std::vector<std::uint8_t> receivers_of(const Renderer& renderer, const glm::vec3& to_light, double sun_angle);

}  // namespace penumbra::render

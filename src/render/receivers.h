#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/renderer.h"

namespace penumbra::render {

// Which pixels of the last frame are receivers, rows top to bottom: 1 where no part of the light is below the surface,
// that is where there is geometry whose normal N_g has N_g · to_light > sin(θ / 2), and, of a spot, the light shines
// there; else 0. θ is the widest angle that the light spans: the params have a sun's size and shape, and a square's is
// from corner to corner. Of several lights, one picture below the other, as Renderer::read_visibilities() has their
// masks.
std::vector<std::uint8_t> receivers_of(const Renderer& renderer, std::span<const FrameLight> lights,
                                       const ParamSet& params);
std::vector<std::uint8_t> receivers_of(const Renderer& renderer, const FrameLight& light, const ParamSet& params);

}  // namespace penumbra::render

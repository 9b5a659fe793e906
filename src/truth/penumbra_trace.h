#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "truth/embree_scene.h"
#include "truth/light.h"
#include "truth/receiver.h"

namespace penumbra::truth {

// Pixels of a picture that are to be traced.
struct PenumbraRequest {
  const scene::PosedGeometry& geometry;
  EyeRays eye;
  std::span<const DrawnPixel> pixels;  // each at most once
  TracedSun sun;
  std::uint32_t rays = 16;  // of a pixel in penumbra; a multiple of 8
  // Pixels: where a penumbra is narrower, on a surface that faces the eye, twice as many rays are traced.
  float narrow = 0;
  std::uint32_t seed = 0;
  int threads = 0;  // 0: one for each core
};

struct PenumbraPixel {
  float visibility = 1;        // 1 where there is no surface
  float blocker_distance = 0;  // metres along the light, harmonic mean of what blocks; 0: nothing
};

// Most pixels that a shadow map can't decide are fully lit or in full shadow nevertheless. So a quarter of the rays is
// traced first, and the others where these differ from each other or from a neighbour's. Where all agree, the pixel has
// that visibility: a little too bright at the lit rim of a penumbra, and too dark at the other. The result does not
// depend on the number of threads, nor on the order of the pixels.
std::vector<PenumbraPixel> trace_penumbrae(const EmbreeScene& scene, const PenumbraRequest& request);

}  // namespace penumbra::truth

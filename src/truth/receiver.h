#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/posed_geometry.h"

namespace penumbra::truth {

// Where light is asked for.
struct Receiver {
  glm::dvec3 position{0};  // world space, metres
  glm::dvec3 normal{0};    // unit: of the triangle itself, towards the eye
  bool there = false;      // false: no surface
  double reach = 0;        // metres from the position to its triangle's furthest corner: scale of rounding errors there
};

// The rays of a picture's pixels: through their centres, NDC 2 (x + ½) / width − 1 and 2 (y + ½) / height − 1.
struct EyeRays {
  glm::dmat4 clip_to_world{1};  // any depth range, reversed or not; perspective or orthographic; x right, y up
  int width = 0, height = 0;
};

// In the place of the surface: nothing is drawn there.
constexpr std::uint32_t no_surface = 0xffffffff;

// The receiver of each pixel, rows from the bottom. `drawn` says for each pixel which surface of `geometry`, and which
// of its triangles, the rasteriser drew. The receiver is where the pixel's ray meets that triangle's plane, in double
// precision, so it may lie outside the triangle by the part of a pixel to which the rasteriser rounds. Where the ray
// runs within the plane, or meets it behind the eye or too far out for a double, it is the corner nearest to the ray.
// Triangles without area, points and lines receive nothing: they are not there.
std::vector<Receiver> receivers_of(const scene::PosedGeometry& geometry, const EyeRays& rays,
                                   std::span<const glm::uvec2> drawn);

}  // namespace penumbra::truth

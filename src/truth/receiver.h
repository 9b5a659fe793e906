#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "scene/posed_geometry.h"

namespace penumbra::truth {

// A point whose visibility of the light is computed.
struct Receiver {
  glm::dvec3 position{0};  // world space, metres
  glm::dvec3 normal{0};    // unit length: the triangle's geometric normal, towards the eye
  bool there = false;      // false: no surface
  double extent = 0;       // metres from the position to its triangle's furthest corner; rounding errors scale with it
};

// The rays of a picture's pixels. They pass through the pixel centres, NDC 2 (x + ½) / width − 1 and 2 (y + ½) / height
// − 1.
struct EyeRays {
  glm::dmat4 clip_to_world{1};  // any depth range, reversed or not; perspective or orthographic; x right, y up
  int width = 0, height = 0;
};

// Index of a pixel without a surface.
constexpr std::uint32_t no_surface = 0xffffffff;

// The receiver of each pixel, rows bottom to top. `drawn` gives, for each pixel, which surface of `geometry` and which
// of its triangles the rasteriser drew. The receiver is where the pixel's ray meets that triangle's plane, in double
// precision, so it may lie outside the triangle by the fraction of a pixel to which the rasteriser rounds. Where the
// ray is parallel to the plane, or meets it behind the eye or too far away for a double, the receiver is the corner
// nearest to the ray. Triangles without area, points and lines are no receivers.
std::vector<Receiver> receivers_of(const scene::PosedGeometry& geometry, const EyeRays& rays,
                                   std::span<const glm::uvec2> drawn);

// A pixel, and which surface and which of its triangles it shows.
struct DrawnPixel {
  glm::ivec2 pixel;
  glm::uvec2 drawn;
};
// The same for some pixels.
std::vector<Receiver> receivers_of(const scene::PosedGeometry& geometry, const EyeRays& rays,
                                   std::span<const DrawnPixel> pixels);

}  // namespace penumbra::truth

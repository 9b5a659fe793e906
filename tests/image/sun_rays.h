#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "shadow/registry.h"

namespace penumbra::test {

// Rays to the sun's centre, or all over its disc, from what the pixels of a renderer's frame show. Pixels are counted
// from the upper left.
class SunRays {
 public:
  SunRays();

  // The built-in registry with the technique "sun_rays", whose frames can be traced. Its mask shows everything lit.
  shadow::Registry registry() const;

  // How casters count whose alpha leaves a part of them: as that part, or, as in shadow_volume, those with a mask as
  // whole and blended ones not at all. For frames from the next one on.
  enum class Alpha { part, as_volumes };
  void set_alpha(Alpha alpha);

  // What follows is about the last frame, whose scene must still exist.

  // Whether rays reach the sun's centre, one value a pixel; true for the sky.
  std::vector<bool> lit() const;
  // The same for these pixels, with rays that start off the surface by `share` times the sum of the eye's distances
  // from the world's origin and from the pixel's surface. For perspective cameras.
  std::vector<bool> lit_off_surface(const std::vector<glm::ivec2>& pixels, double share) const;
  // For each of these pixels, whether it is within a pixel of an edge: whether rays from a grid of 17 x 17 points less
  // than a pixel away in x and y, on the plane of the triangle that the pixel shows, disagree with each other.
  std::vector<bool> edges(const std::vector<glm::ivec2>& pixels) const;

  // The share of the sun's disc that each pixel of a rectangle sees, row by row from the top; 1 for the sky.
  std::vector<float> visibility(const glm::ivec2& first, const glm::ivec2& size, int samples) const;

  // Whether alpha leaves a part of casters with an alpha mask, and of blended ones.
  bool masked_casters() const;
  bool blended_casters() const;

 private:
  struct Frame;
  std::shared_ptr<Frame> frame_;
};

}  // namespace penumbra::test

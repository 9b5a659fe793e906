#include <algorithm>
#include <limits>

#include "../core/error.h"
#include "check_parts.h"

namespace penumbra::shadow {

namespace {

// How depth follows the distance from the camera, from the inverse of any projection: a perspective or an orthographic
// one, also with an oblique near plane.
class DepthOfDistance {
 public:
  explicit DepthOfDistance(const glm::dmat4& projection) : clip_to_view_(glm::inverse(projection)) {}

  // Positive where the distance grows with the depth along the ray through the middle of the picture, negative where it
  // falls.
  double direction() const {
    const glm::dvec4 &by_depth = clip_to_view_[2], &middle = clip_to_view_[3];
    return middle.z * by_depth.w - by_depth.z * middle.w;
  }

  // The least depth in NDC that a perspective has infinitely far away, which is where w of view space is 0. -infinity
  // if the projection is orthographic.
  double least_at_infinity() const {
    const double by_depth = clip_to_view_[2].w;
    if (by_depth == 0) return -std::numeric_limits<double>::infinity();
    double least = std::numeric_limits<double>::infinity();
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) {
        const double w = x * clip_to_view_[0].w + y * clip_to_view_[1].w + clip_to_view_[3].w;
        least = std::min(least, -w / by_depth);
      }
    }
    return least;
  }

 private:
  glm::dmat4 clip_to_view_;
};

}  // namespace

void check_conventions(const glm::mat4& projection, const Conventions& conventions) {
  const DepthOfDistance depth{glm::dmat4(projection)};
  const bool reversed = depth.direction() < 0;
  if (reversed != conventions.reversed_z) {
    fail("soft shadows: the projection's depth {} with the distance, but Conventions::reversed_z is {}",
         reversed ? "falls" : "grows", conventions.reversed_z);
  }
  constexpr double rounding = 1e-3;
  const double least = depth.least_at_infinity();
  if (reversed && !conventions.depth_zero_to_one && least > -1 + rounding) {
    fail("soft shadows: the projection's depth is above {:.3g} everywhere, but Conventions::depth_zero_to_one is false",
         least + 0.0);  // not "-0"
  }
}

}  // namespace penumbra::shadow

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "../core/error.h"
#include "check_parts.h"

namespace penumbra::shadow {

namespace {

// How depth follows the distance from the camera, from the inverse of any projection: a perspective or an orthographic
// one, also with an oblique near plane.
class DepthOfDistance {
 public:
  explicit DepthOfDistance(const glm::mat4& projection) : clip_to_view_(glm::inverse(glm::dmat4(projection))) {}

  // Whether the distance falls where the depth grows, along the ray through the middle of the picture.
  bool reversed() const {
    const glm::dvec4 &by_depth = clip_to_view_[2], &middle = clip_to_view_[3];
    return middle.z * by_depth.w - by_depth.z * middle.w < 0;
  }

  // The least depth in NDC that a perspective has infinitely far away, which is where w of view space is 0. None for an
  // orthographic projection, whose depths have no bounds.
  std::optional<double> least_at_infinity() const {
    const double by_depth = clip_to_view_[2].w;
    if (by_depth == 0) return {};
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

constexpr double least_far_depth = -1 + 1e-3;  // of reversed Z in -1..1, with what matrices round away

}  // namespace

void check_conventions(const glm::mat4& projection, const Conventions& conventions) {
  const DepthOfDistance depth(projection);
  if (depth.reversed() != conventions.reversed_z) {
    fail("soft shadows: the projection's depth {} with the distance, but the conventions say reversed_z={}",
         depth.reversed() ? "falls" : "grows", conventions.reversed_z);
  }
  const std::optional<double> least = depth.least_at_infinity();
  if (conventions.reversed_z && !conventions.depth_zero_to_one && least && *least > least_far_depth) {
    fail(
        "soft shadows: the projection's depth is above {:.3g} everywhere, but the conventions say "
        "depth_zero_to_one=false",
        *least + 0.0);  // not "-0"
  }
}

std::string clip_control_warning(const glm::mat4& projection, const Conventions& conventions, bool zero_to_one) {
  if (zero_to_one == conventions.depth_zero_to_one) return "";
  // Programs that draw with reversed Z in 0..1 know of glClipControl, and may have set it back since they drew depth.
  const std::optional<double> least = DepthOfDistance(projection).least_at_infinity();
  const bool sure = conventions.reversed_z && !(least && *least <= least_far_depth);
  if (conventions.depth_zero_to_one && sure) return "";
  return fmt::format(
      "soft shadows: depth is said to be drawn with z in {} (depth_zero_to_one of the conventions), but glClipControl "
      "is at "
      "{}. If depth was drawn so, shadows are wrong; if it was not, set glClipControl as it was before the first frame",
      conventions.depth_zero_to_one ? "0..1" : "-1..1", zero_to_one ? "0..1" : "-1..1");
}

}  // namespace penumbra::shadow

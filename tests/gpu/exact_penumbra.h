#pragma once

// Penumbrae in closed form: of a half-plane's straight edge.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>
#include <vector>

namespace penumbra::test {

// Visibility of a disc or a square sun at zenith under a half-plane, t = distance to its edge over the penumbra's
// radius.
inline double exact_disc(double t) {
  t = std::clamp(t, -1.0, 1.0);
  return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / glm::pi<double>();
}
inline double exact_square(double t) { return 0.5 + 0.5 * std::clamp(t, -1.0, 1.0); }

// The exact function for a sun anywhere: a ray from the receiver misses the half-plane when a linear function of the
// disc's point is positive, so that the visibility is that of a disc cut by a line.
inline double exact_oblique(const glm::dvec3& to_light, double x, double height, double tan_half_angle) {
  const glm::dvec3 u = glm::normalize(glm::cross(to_light, glm::dvec3(0.31, 0.2, 0.93)));
  const glm::dvec3 w = glm::cross(to_light, u);
  const auto along = [&](const glm::dvec3& d) { return height * d.x + x * d.y; };
  return exact_disc(along(to_light) / (tan_half_angle * std::hypot(along(u), along(w))));
}

// Distance over which a rising profile goes from 10 to 90 % of its range.
inline double width_10_90(const std::vector<double>& profile, double step) {
  const auto crossing = [&](double level) {
    for (std::size_t i = 1; i < profile.size(); ++i) {
      if (profile[i - 1] < level && profile[i] >= level) {
        return static_cast<double>(i - 1) + (level - profile[i - 1]) / (profile[i] - profile[i - 1]);
      }
    }
    return std::nan("");
  };
  return (crossing(0.9) - crossing(0.1)) * step;
}

}  // namespace penumbra::test

#include "sampling.h"

#include <cmath>

#include "lib/disc.glsl"

namespace penumbra::shadow {

namespace {
constexpr double golden_ratio = 0.61803398874989484820;
}

float radical_inverse_2(unsigned k) {
  double value = 0;
  double digit = 0.5;
  for (; k != 0; k >>= 1U, digit *= 0.5) value += (k & 1U) != 0 ? digit : 0.0;
  return static_cast<float>(value);
}

std::vector<glm::vec2> square_points(std::string_view pattern, int count) {
  std::vector<glm::vec2> points;
  for (int k = 0; k < count; ++k) {
    const float x = (static_cast<float>(k) + 0.5f) / static_cast<float>(count);
    const double y = pattern == "vogel" ? std::fmod((k + 0.5) * golden_ratio, 1.0)
                                        : radical_inverse_2(static_cast<unsigned>(k)) + 0.5 / count;
    points.emplace_back(x, std::fmod(y, 1.0));
  }
  return points;
}

std::vector<glm::vec2> disc_points(std::string_view pattern, int count) {
  std::vector<glm::vec2> points;
  for (const glm::vec2& u : square_points(pattern, count)) {
    if (pattern == "vogel") {
      const double angle = 6.283185307179586 * u.y;
      const double radius = std::sqrt(static_cast<double>(u.x));
      points.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    } else {
      points.push_back(glsl::concentric_disc(u));
    }
  }
  return points;
}

}  // namespace penumbra::shadow

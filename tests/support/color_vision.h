#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <string>

namespace penumbra::test {

using ColorBytes = std::array<std::uint8_t, 3>;  // sRGB

struct Vision {
  std::string name;
  std::array<glm::vec3, 3> rows;  // linear Rec. 709 to what is seen of it
};

// Machado, Oliveira and Fernandes 2009, "A physiologically-based model for simulation of color vision deficiency", of
// full severity.
inline const std::array<Vision, 4>& visions() {
  static const std::array<Vision, 4> all{
      Vision{"usual", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
      Vision{"protanopia",
             {{{0.152286f, 1.052583f, -0.204868f},
               {0.114503f, 0.786281f, 0.099216f},
               {-0.003882f, -0.048116f, 1.051998f}}}},
      Vision{
          "deuteranopia",
          {{{0.367322f, 0.860646f, -0.227968f}, {0.280085f, 0.672501f, 0.047413f}, {-0.01182f, 0.04294f, 0.968881f}}}},
      Vision{"tritanopia",
             {{{1.255528f, -0.076749f, -0.178779f},
               {-0.078411f, 0.930809f, 0.147602f},
               {0.004733f, 0.691367f, 0.3039f}}}}};
  return all;
}

// CIE 1976 L*a*b* of what is seen.
inline glm::vec3 lab(const Vision& vision, const ColorBytes& color) {
  const auto linear = [](std::uint8_t byte) {
    const float v = static_cast<float>(byte) / 255.0f;
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
  };
  const auto lightness = [](float t) { return t > 0.008856f ? std::cbrt(t) : 7.787f * t + 16.0f / 116.0f; };
  const glm::vec3 stored(linear(color[0]), linear(color[1]), linear(color[2]));
  glm::vec3 c;
  for (int i = 0; i < 3; ++i) c[i] = std::clamp(glm::dot(vision.rows[static_cast<std::size_t>(i)], stored), 0.0f, 1.0f);
  const float x = lightness((0.4124f * c.x + 0.3576f * c.y + 0.1805f * c.z) / 0.9505f);
  const float y = lightness(0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z);
  const float z = lightness((0.0193f * c.x + 0.1192f * c.y + 0.9505f * c.z) / 1.089f);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

// The distance of two colours in L*a*b* for those who tell them apart worst.
inline float apart(const ColorBytes& a, const ColorBytes& b) {
  float least = std::numeric_limits<float>::max();
  for (const Vision& vision : visions()) least = std::min(least, glm::distance(lab(vision, a), lab(vision, b)));
  return least;
}

// Whether people call it red or pink: a hue of L*a*b* from -30 to 65 degrees, and not grey. Orange begins above.
inline bool is_reddish(const ColorBytes& color) {
  const glm::vec3 seen = lab(visions()[0], color);
  const float hue = std::atan2(seen.z, seen.y) * 180.0f / std::numbers::pi_v<float>;
  return std::hypot(seen.y, seen.z) > 15 && hue > -30 && hue < 65;
}

}  // namespace penumbra::test

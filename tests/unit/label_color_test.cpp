// The colours of labels can be told apart by people who see colours in other ways.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <string>

#include "render/aov_picture.h"

namespace penumbra::test {
namespace {

struct Vision {
  std::string name;
  std::array<glm::vec3, 3> rows;  // linear Rec. 709 to what is seen of it
};

// Machado, Oliveira and Fernandes 2009, "A physiologically-based model for simulation of color vision deficiency", of
// full severity.
const std::array<Vision, 4> visions{
    Vision{"usual", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
    Vision{
        "protanopia",
        {{{0.152286f, 1.052583f, -0.204868f}, {0.114503f, 0.786281f, 0.099216f}, {-0.003882f, -0.048116f, 1.051998f}}}},
    Vision{"deuteranopia",
           {{{0.367322f, 0.860646f, -0.227968f}, {0.280085f, 0.672501f, 0.047413f}, {-0.01182f, 0.04294f, 0.968881f}}}},
    Vision{
        "tritanopia",
        {{{1.255528f, -0.076749f, -0.178779f}, {-0.078411f, 0.930809f, 0.147602f}, {0.004733f, 0.691367f, 0.3039f}}}}};

float linear(std::uint8_t byte) {
  const float v = static_cast<float>(byte) / 255.0f;
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

float lightness(float t) { return t > 0.008856f ? std::cbrt(t) : 7.787f * t + 16.0f / 116.0f; }

// CIE 1976 L*a*b* of what is seen.
glm::vec3 lab(const Vision& vision, float label) {
  const std::array<std::uint8_t, 3> color = render::label_color(label);
  const glm::vec3 stored(linear(color[0]), linear(color[1]), linear(color[2]));
  glm::vec3 c;
  for (int i = 0; i < 3; ++i) c[i] = std::clamp(glm::dot(vision.rows[static_cast<std::size_t>(i)], stored), 0.0f, 1.0f);
  const float x = lightness((0.4124f * c.x + 0.3576f * c.y + 0.1805f * c.z) / 0.9505f);
  const float y = lightness(0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z);
  const float z = lightness((0.0193f * c.x + 0.1192f * c.y + 0.9505f * c.z) / 1.089f);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

TEST(LabelColor, AreFarApartForEveryKindOfColourVision) {
  for (const Vision& vision : visions) {
    for (int a = 0; a < render::label_color_count; ++a) {
      for (int b = 0; b < a; ++b) {
        const float apart = glm::distance(lab(vision, static_cast<float>(a)), lab(vision, static_cast<float>(b)));
        EXPECT_GT(apart, 15) << vision.name << ": labels " << a << " and " << b;
      }
    }
  }
}

// In the AOV "history" 0 is a pixel whose history is used.
TEST(LabelColor, TheFirstIsNotRed) {
  const std::array<std::uint8_t, 3> first = render::label_color(0);
  EXPECT_LT(first[0], first[2]);
}

}  // namespace
}  // namespace penumbra::test

#pragma once

#include <cmath>

namespace penumbra::metrics {

// The colour spaces of FLIP, for the white point D65 of sRGB.

struct Color {
  float x = 0, y = 0, z = 0;
};

inline constexpr Color white_xyz{0.950428545f, 1.0f, 1.088900371f};

// Decodes an sRGB value to linear light (IEC 61966-2-1).
inline float srgb_decoded(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }

inline Color xyz_of_linear(const Color& rgb) {
  return {0.412386563f * rgb.x + 0.357591491f * rgb.y + 0.180450491f * rgb.z,
          0.212636822f * rgb.x + 0.715182982f * rgb.y + 0.072180196f * rgb.z,
          0.019330620f * rgb.x + 0.119197164f * rgb.y + 0.950372587f * rgb.z};
}

inline Color linear_of_xyz(const Color& xyz) {
  return {3.241003233f * xyz.x - 1.537398969f * xyz.y - 0.498615882f * xyz.z,
          -0.969224252f * xyz.x + 1.875929984f * xyz.y + 0.041554226f * xyz.z,
          0.055639420f * xyz.x - 0.204011206f * xyz.y + 1.057148977f * xyz.z};
}

// The opponent space in which contrast sensitivity is known: luminance, red-green, blue-yellow. A linear form of
// CIELAB.
inline Color ycxcz_of_xyz(const Color& xyz) {
  const float x = xyz.x / white_xyz.x, y = xyz.y / white_xyz.y, z = xyz.z / white_xyz.z;
  return {116.0f * y - 16.0f, 500.0f * (x - y), 200.0f * (y - z)};
}

inline Color xyz_of_ycxcz(const Color& color) {
  const float y = (color.x + 16.0f) / 116.0f;
  return {(color.y / 500.0f + y) * white_xyz.x, y * white_xyz.y, (y - color.z / 200.0f) * white_xyz.z};
}

inline float lab_curve(float t) {
  constexpr float delta = 6.0f / 29.0f;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
}

// CIELAB with the Hunt effect: colours look less saturated at low luminance.
inline Color hunt_lab_of_xyz(const Color& xyz) {
  const float x = lab_curve(xyz.x / white_xyz.x), y = lab_curve(xyz.y / white_xyz.y),
              z = lab_curve(xyz.z / white_xyz.z);
  const float lightness = 116.0f * y - 16.0f, hunt = 0.01f * lightness;
  return {lightness, 500.0f * (x - y) * hunt, 200.0f * (y - z) * hunt};
}

// HyAB, a colour distance that also holds for large differences (Abasi et al. 2020).
inline float hyab(const Color& a, const Color& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

}  // namespace penumbra::metrics

// The mip levels of a material's textures.

#include "scene/mip_levels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace penumbra::test {
namespace {

using Texel = std::array<std::uint8_t, 4>;

scene::Image image_of(int width, int height, const std::vector<Texel>& texels) {
  scene::Image image{.name = "image", .width = width, .height = height, .rgba = {}};
  for (const Texel& texel : texels) image.rgba.insert(image.rgba.end(), texel.begin(), texel.end());
  return image;
}

Texel texel_of(const scene::MipLevel& level, std::size_t index) {
  return {level.rgba[4 * index], level.rgba[4 * index + 1], level.rgba[4 * index + 2], level.rgba[4 * index + 3]};
}

TEST(MipLevels, HalveDownToOneTexel) {
  const auto levels = scene::mip_levels(image_of(5, 2, std::vector<Texel>(10)), false);
  ASSERT_EQ(levels.size(), 2u);
  EXPECT_EQ(levels[0].width, 2);
  EXPECT_EQ(levels[0].height, 1);
  EXPECT_EQ(levels[1].width, 1);
  EXPECT_EQ(levels[1].height, 1);
  EXPECT_EQ(levels[0].rgba.size(), 8u);
  EXPECT_TRUE(scene::mip_levels(image_of(1, 1, {Texel{}}), false).empty());
}

TEST(MipLevels, OfOneColorHaveThatColor) {
  for (const bool srgb : {false, true}) {
    for (int code = 0; code < 256; ++code) {
      const Texel color{static_cast<std::uint8_t>(code), 0, 255, static_cast<std::uint8_t>(255 - code)};
      for (const scene::MipLevel& level : scene::mip_levels(image_of(7, 6, std::vector<Texel>(42, color)), srgb)) {
        for (std::size_t i = 0; i < level.rgba.size() / 4; ++i) EXPECT_EQ(texel_of(level, i), color) << code;
      }
    }
  }
}

// Half of the light of white is 188 in sRGB. Alpha holds no colour.
TEST(MipLevels, AverageLightAndAlpha) {
  const scene::Image halves = image_of(2, 2, {{255, 0, 10, 255}, {0, 0, 20, 0}, {255, 0, 30, 255}, {0, 0, 40, 0}});
  EXPECT_EQ(texel_of(scene::mip_levels(halves, false)[0], 0), (Texel{128, 0, 25, 128}));
  const Texel light = texel_of(scene::mip_levels(halves, true)[0], 0);
  EXPECT_EQ(light[0], 188);
  EXPECT_EQ(light[3], 128);
}

// Each texel of the level above has the same weight in the sum, whether the size is even or odd: nothing is lost at the
// edge.
TEST(MipLevels, CoverEveryTexelEqually) {
  for (const int size : {3, 5, 8, 9}) {
    for (int lit = 0; lit < size; ++lit) {
      std::vector<Texel> row(static_cast<std::size_t>(size), Texel{0, 0, 0, 0});
      row[static_cast<std::size_t>(lit)] = {255, 255, 255, 255};
      const scene::MipLevel level = scene::mip_levels(image_of(size, 1, row), false)[0];
      double sum = 0;
      for (std::size_t i = 0; i < level.rgba.size() / 4; ++i) sum += texel_of(level, i)[0];
      EXPECT_NEAR(sum / level.width, 255.0 / size, 0.5) << size << ", " << lit;
    }
  }
}

}  // namespace
}  // namespace penumbra::test

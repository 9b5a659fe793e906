// FLIP compared with the results of its authors' tool, properties that hold for any pair of pictures, and the colours
// of heat maps.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/error.h"
#include "image/read.h"
#include "metrics/flip.h"
#include "metrics/heat_color.h"
#include "support/pictures.h"

namespace penumbra::metrics {
namespace {

namespace fs = std::filesystem;
using test::Grey;

struct Rgb {
  int width = 0, height = 0;
  std::vector<float> pixels;
  operator ImageView() const { return {width, height, pixels, 3}; }  // NOLINT(google-explicit-constructor)
};

Rgb read(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const scene::Image image = image::read_image(std::as_bytes(std::span(text)), path.string(), 1 << 20);
  Rgb rgb{image.width, image.height, {}};
  for (std::size_t i = 0; i < image.rgba.size(); ++i)
    if (i % 4 != 3) rgb.pixels.push_back(static_cast<float>(image.rgba[i]) / 255);
  return rgb;
}

Rgb colored(const Grey& grey) {
  Rgb rgb{grey.width, grey.height, {}};
  for (const float value : grey.pixels) rgb.pixels.insert(rgb.pixels.end(), 3, value);
  return rgb;
}

TEST(Flip, MatchesTheAuthorsTool) {
  const char* const assets = std::getenv("PENUMBRA_ASSETS");
  const fs::path folder = fs::path(assets == nullptr ? "" : assets) / "flip_ref";
  if (!fs::is_directory(folder)) GTEST_SKIP() << "skipped: PENUMBRA_ASSETS names no folder with flip_ref";
  const Rgb reference = read(folder / "ref.png");
  const std::vector<std::pair<const char*, double>> means{
      {"ref", 0.000004},    {"noise", 0.131176},     {"blur", 0.176364}, {"shift", 0.139724},
      {"darker", 0.297818}, {"fireflies", 0.009188}, {"black", 0.788823}};
  for (const auto& [name, mean] : means)
    EXPECT_NEAR(flip(read(folder / (std::string(name) + ".png")), reference).mean, mean, 1e-4) << name;
}

TEST(Flip, OfBlackAndWhiteIsNearlyOne) {
  // Both pictures are flat and so have no features: the distance in lightness is 100, that of screen green and blue
  // 203.3, and 0.95 + 0.05 (100^0.7 - 0.4 m) / (0.6 m) with m = 203.3^0.7 is 0.9674.
  const Grey black(32, 32, 0.0f), white(32, 32, 1.0f);
  EXPECT_NEAR(flip(black, white).mean, 0.9674, 0.0002);
  EXPECT_EQ(flip(white, white).mean, 0);
}

TEST(Flip, ShowsOneChannelAsGrey) {
  const Grey a = test::ramp(40, 30, 12), b = test::ramp(40, 30, 5);
  const Flip grey = flip(b, a), color = flip(colored(b), colored(a));
  EXPECT_GT(grey.mean, 0.01);
  EXPECT_NEAR(grey.mean, color.mean, 1e-5);
  for (std::size_t i = 0; i < grey.map.size(); ++i) EXPECT_NEAR(grey.map[i], color.map[i], 1e-3) << i;
}

TEST(Flip, ItsMeanIsThatOfItsMapOverReceivers) {
  const Grey a(30, 20, 0.5f);
  Grey b = a;
  for (int y = 0; y < 20; ++y) b.at(5, y) = 1;
  std::vector<std::uint8_t> receivers(a.pixels.size(), 1);
  for (std::size_t y = 0; y < 20; ++y) receivers[y * 30 + 29] = 0;
  const Flip difference = flip(b, a, receivers);
  double sum = 0;
  for (const float error : difference.map) sum += error;
  EXPECT_NEAR(difference.mean, sum / (29 * 20), 1e-6);
  EXPECT_GT(difference.map[5], 0.3f);
  EXPECT_EQ(difference.map[29], 0);
}

TEST(Flip, WhatIsNoReceiverChangesNothing) {
  const Grey a(30, 20, 0.5f);
  Grey b = a;
  b.at(7, 7) = std::numeric_limits<float>::quiet_NaN();
  b.at(8, 7) = 1.0f;
  std::vector<std::uint8_t> receivers(a.pixels.size(), 1);
  receivers[7 * 30 + 7] = receivers[7 * 30 + 8] = 0;
  EXPECT_EQ(flip(b, a, receivers).mean, 0);
  EXPECT_EQ(flip(b, a).map[7 * 30 + 7], 1) << "a receiver's value that is no number is the error 1";
}

TEST(Flip, OfTinyAndEmptyPictures) {
  const Grey one(1, 1, 0.0f), other(1, 1, 1.0f), empty(0, 0, 0.0f);
  EXPECT_NEAR(flip(one, other).mean, 0.9674, 0.0002);
  EXPECT_TRUE(std::isnan(flip(empty, empty).mean));
  const std::vector<float> two(2);
  EXPECT_THROW(flip({1, 1, two, 2}, {1, 1, two, 2}), Error);
}

TEST(Flip, SeesLessFromFartherAway) {
  const Grey even(64, 64, 0.5f), fine(64, 64, [](int x, int y) { return (x + y) % 2; });
  EXPECT_GT(flip(fine, even, {}, 15).mean, 1.5 * flip(fine, even, {}, 120).mean);
}

TEST(HeatColor, GetsLighterInEqualSteps) {
  const auto lightness = [](float error) {  // CIELAB's L*
    const auto color = heat_color(error);
    const auto linear = [](std::uint8_t v) {
      const double s = v / 255.0;
      return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    };
    const double y = 0.2126 * linear(color[0]) + 0.7152 * linear(color[1]) + 0.0722 * linear(color[2]);
    return y > 0.008856 ? 116 * std::cbrt(y) - 16 : 903.3 * y;
  };
  for (int i = 1; i <= 16; ++i) {
    const double step = lightness(static_cast<float>(i) / 16) - lightness(static_cast<float>(i - 1) / 16);
    EXPECT_NEAR(step, 6, 1) << i;
  }
  EXPECT_EQ(heat_color(0), (std::array<std::uint8_t, 3>{0, 0, 0}));
  EXPECT_EQ(heat_color(7), heat_color(1));
  EXPECT_EQ(heat_color(-7), heat_color(0));
  EXPECT_EQ(heat_color(std::numeric_limits<float>::quiet_NaN()), heat_color(1));
}

}  // namespace
}  // namespace penumbra::metrics

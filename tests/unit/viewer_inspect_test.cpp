// How the viewer converts numbers to colours, and which pixel is under the cursor.
#include "viewer/inspect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "render/aov_picture.h"
#include "support/color_vision.h"
#include "viewer/present.h"

namespace penumbra {
namespace {

using viewer::ColorMapping;
using viewer::ColorScale;
using viewer::Range;
using viewer::Values;

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr std::array scales{ColorScale::grey, ColorScale::heat, ColorScale::rgb, ColorScale::vectors,
                            ColorScale::labels};

Values values_of(const std::vector<float>& numbers) {
  return {.width = static_cast<int>(numbers.size()), .height = 1, .channels = 1, .numbers = numbers};
}

// 1, 2 or 5 of some power of ten, or 0.
bool is_round(float value) {
  if (value == 0) return true;
  const double digits = std::abs(value) / std::pow(10.0, std::floor(std::log10(std::abs(value) * 1.0001)));
  return std::abs(digits - 1) < 1e-3 || std::abs(digits - 2) < 1e-3 || std::abs(digits - 5) < 1e-3;
}

// The colour of pixel (x, y), counted from the upper left; the rows of `rgba` run from bottom to top.
glm::ivec3 color_in(const Values& values, const std::vector<std::uint8_t>& rgba, int x, int y) {
  const auto at = static_cast<std::size_t>((values.height - 1 - y) * values.width + x) * 4;
  EXPECT_EQ(rgba.at(at + 3), 255);
  return {rgba.at(at), rgba.at(at + 1), rgba.at(at + 2)};
}

TEST(ViewerInspect, TheRangeHoldsAllFiniteValuesAndIsRound) {
  std::mt19937 random(5);
  for (const ColorScale scale : {ColorScale::heat, ColorScale::vectors}) {
    for (int i = 0; i < 2000; ++i) {
      const float most = std::pow(10.0f, std::uniform_real_distribution(-6.0f, 5.0f)(random));
      std::uniform_real_distribution<float> any(i % 2 == 0 ? 0 : -most, most);
      const Values values = values_of({any(random), any(random), nan, infinity, -infinity, any(random)});
      const Range range = range_of({.what = "depth"}, {.scale = scale}, values);
      const float low = scale == ColorScale::vectors ? -range.high : range.low;
      for (const float v : values.numbers) {
        if (!std::isfinite(v)) continue;
        EXPECT_TRUE(v >= low && v <= range.high) << v << " in " << low << ", " << range.high;
      }
      EXPECT_TRUE(is_round(range.low) && is_round(range.high)) << range.low << ", " << range.high;
      EXPECT_LT(range.low, range.high);
      EXPECT_LE(range.high, std::max(3 * most, 0.001f)) << "nothing could be told apart";
    }
  }
}

TEST(ViewerInspect, ValuesBeyondAllRoundNumbersAreHeldToo) {
  for (const float huge : {2e5f, 4.3e9f, std::numeric_limits<float>::max()}) {
    EXPECT_GE(range_of({}, {}, values_of({0, huge})).high, huge);
    EXPECT_LE(range_of({}, {}, values_of({-huge, 0})).low, -huge);
  }
}

TEST(ViewerInspect, NoFiniteValueIsNoFault) {
  for (const Values& values : {values_of({nan, infinity, -infinity}), values_of({0, 0}), Values{}}) {
    const Range range = range_of({}, {}, values);
    EXPECT_LT(range.low, range.high);
    EXPECT_LE(range.high, 1);
  }
}

TEST(ViewerInspect, AHandsRangeAndAKnownOneAreKept) {
  const Values values = values_of({-5, 70});
  const Range by_hand = range_of({.automatic = false, .low = 3, .high = 4}, {.fixed = true}, values);
  EXPECT_EQ(by_hand.low, 3);
  EXPECT_EQ(by_hand.high, 4);
  const Range fixed = range_of({}, viewer::mapping_of("shadow"), values);
  EXPECT_EQ(fixed.low, 0);
  EXPECT_EQ(fixed.high, 1);
}

TEST(ViewerInspect, EveryValueHasAColorWhateverTheRange) {
  const float most = std::numeric_limits<float>::max();
  for (const ColorScale scale : scales) {
    for (const int channels : {1, 2, 3}) {
      Values values{.width = 4, .height = 3, .channels = channels};
      values.numbers = {nan, infinity, -infinity, 0, -0.0f, 1, -1, most, -most, 1e-45f, 7.5f, -7.5f};
      values.numbers.resize(static_cast<std::size_t>(12 * channels), nan);
      for (const Range range : {Range{0, 1}, Range{0, 0}, Range{1, 0}, Range{-most, most}, Range{nan, nan}})
        EXPECT_EQ(colors_of(values, {.scale = scale}, range).size(), 48u);
    }
  }
}

TEST(ViewerInspect, TheLegendHasTheColorsOfThePicture) {
  for (const ColorScale scale : {ColorScale::grey, ColorScale::heat}) {
    for (int i = 0; i <= 10; ++i) {
      const float part = static_cast<float>(i) / 10;
      const Values values = values_of({2 + 3 * part});
      const glm::ivec3 seen = color_in(values, colors_of(values, {.scale = scale}, {2, 5}), 0, 0);
      EXPECT_LE(glm::distance(glm::vec3(seen) / 255.0f, viewer::color_at(scale, part)), 0.03f) << part;
    }
  }
  for (int label = 0; label < 8; ++label) {
    const Values values = values_of({static_cast<float>(label)});
    const glm::ivec3 seen = color_in(values, colors_of(values, {.scale = ColorScale::labels}, {0, 1}), 0, 0);
    EXPECT_EQ(glm::vec3(seen) / 255.0f, viewer::color_at(ColorScale::labels, static_cast<float>(label)));
  }
}

TEST(ViewerInspect, WhatLiesOutsideOfTheRangeHasTheColorOfItsEnds) {
  const Values values = values_of({0, 1, 5, infinity, -3, -infinity});
  for (const ColorScale scale : {ColorScale::grey, ColorScale::heat, ColorScale::rgb}) {
    const std::vector<std::uint8_t> rgba = colors_of(values, {.scale = scale}, {0, 1});
    for (const int x : {2, 3}) EXPECT_EQ(color_in(values, rgba, x, 0), color_in(values, rgba, 1, 0)) << x;
    for (const int x : {4, 5}) EXPECT_EQ(color_in(values, rgba, x, 0), color_in(values, rgba, 0, 0)) << x;
    EXPECT_NE(color_in(values, rgba, 0, 0), color_in(values, rgba, 1, 0));
  }
}

TEST(ViewerInspect, LabelsTellNeighboursApartAndNoneIsBlack) {
  const Values values = values_of({-1, nan, 0, 1, 2, 3, 4, 5, 6, 7});
  const std::vector<std::uint8_t> rgba = colors_of(values, {.scale = ColorScale::labels}, {0, 1});
  EXPECT_EQ(color_in(values, rgba, 0, 0), glm::ivec3(0));
  EXPECT_EQ(color_in(values, rgba, 1, 0), glm::ivec3(0));
  for (int a = 2; a < 10; ++a) {
    for (int b = 0; b < a; ++b) {
      if (b == 1) continue;
      EXPECT_NE(color_in(values, rgba, a, 0), color_in(values, rgba, b, 0)) << a << " and " << b;
    }
  }
}

TEST(ViewerInspect, PicturesStandUprightWithTheirChannelsInPlace) {
  Values values{.width = 2, .height = 2, .channels = 3};
  values.numbers = {1, 0, 0, /**/ 0, 1, 0, /**/ 0, 0, 1, /**/ 1, 1, 1};
  EXPECT_EQ(values.at(1, 0)[1], 1);
  EXPECT_EQ(values.at(0, 1)[2], 1);
  const std::vector<std::uint8_t> rgba = colors_of(values, {.scale = ColorScale::rgb}, {0, 1});
  EXPECT_EQ(color_in(values, rgba, 0, 0), glm::ivec3(255, 0, 0));
  EXPECT_EQ(color_in(values, rgba, 1, 0), glm::ivec3(0, 255, 0));
  EXPECT_EQ(color_in(values, rgba, 0, 1), glm::ivec3(0, 0, 255));
  EXPECT_EQ(color_in(values, rgba, 1, 1), glm::ivec3(255, 255, 255));
}

TEST(ViewerInspect, VectorsLieAboutGrey) {
  Values values{.width = 3, .height = 1, .channels = 2};
  values.numbers = {0, 0, /**/ 4, -4, /**/ -2, 2};
  const std::vector<std::uint8_t> rgba = colors_of(values, {.scale = ColorScale::vectors}, {0, 4});
  EXPECT_EQ(color_in(values, rgba, 0, 0), glm::ivec3(128));
  EXPECT_EQ(color_in(values, rgba, 1, 0), glm::ivec3(255, 0, 128));
  EXPECT_EQ(color_in(values, rgba, 2, 0), glm::ivec3(64, 191, 128));
}

TEST(ViewerInspect, EveryAovHasFittingColours) {
  for (const render::Aov& aov : render::aovs()) {
    const ColorMapping mapping = viewer::mapping_of(aov.name);
    const bool is_vector = aov.channels.size() > 1;
    EXPECT_EQ(mapping.scale == ColorScale::rgb || mapping.scale == ColorScale::vectors, is_vector) << aov.name;
    EXPECT_EQ(mapping.scale == ColorScale::labels, !mapping.labels.empty()) << aov.name;
    EXPECT_EQ(mapping.unit == "m", aov.help.find(", m;") != std::string::npos) << aov.name;
    EXPECT_EQ(mapping.unit == "px", aov.in_pixels) << aov.name;
  }
}

std::array<std::uint8_t, 3> shown(ColorScale scale, float value) {
  const glm::vec3 color = viewer::color_at(scale, value) * 255.0f;
  return {static_cast<std::uint8_t>(std::lround(color.r)), static_cast<std::uint8_t>(std::lround(color.g)),
          static_cast<std::uint8_t>(std::lround(color.b))};
}

TEST(ViewerInspect, LabelsOfAnAovCanBeToldApartWithEveryKindOfColourVision) {
  int aovs = 0;
  for (const render::Aov& aov : render::aovs()) {
    const std::vector<std::string> labels = viewer::mapping_of(aov.name).labels;
    if (labels.empty()) continue;
    ++aovs;
    EXPECT_LE(labels.size(), static_cast<std::size_t>(render::label_color_count)) << aov.name << ": colours repeat";
    for (std::size_t a = 0; a < labels.size(); ++a) {
      const auto color = shown(ColorScale::labels, static_cast<float>(a));
      EXPECT_GT(test::apart(color, {}), 15) << aov.name << ": the sky and " << labels[a];
      for (std::size_t b = 0; b < a; ++b) {
        EXPECT_GT(test::apart(color, shown(ColorScale::labels, static_cast<float>(b))), 15)
            << aov.name << ": " << labels[a] << " and " << labels[b];
      }
    }
  }
  EXPECT_EQ(aovs, 3);
}

TEST(ViewerInspect, WhatIsFineIsNeverRed) {
  // Of each AOV with labels: those that say that all is well.
  const std::map<std::string, std::vector<std::string>> fine{
      {"cascade", {"0 (finest)"}}, {"under_texel", {"wider than a texel"}}, {"history", {"kept"}}};
  for (const render::Aov& aov : render::aovs()) {
    const std::vector<std::string> labels = viewer::mapping_of(aov.name).labels;
    if (labels.empty()) continue;
    ASSERT_TRUE(fine.contains(aov.name)) << aov.name << ": which of its labels are fine?";
    for (const std::string& label : fine.at(aov.name)) {
      const auto at = std::ranges::find(labels, label);
      ASSERT_NE(at, labels.end()) << aov.name << ": " << label;
      const auto value = static_cast<float>(at - labels.begin());
      EXPECT_FALSE(test::is_reddish(shown(ColorScale::labels, value))) << aov.name << ": " << label;
      const render::ByteImage png = render::aov_bytes(aov.name, 1, {value});
      if (png.channels == 3) {
        EXPECT_FALSE(test::is_reddish({png.pixels[0], png.pixels[1], png.pixels[2]})) << aov.name << ".png: " << label;
      }
    }
  }
  // No error, no width, no distance.
  EXPECT_FALSE(test::is_reddish(shown(ColorScale::heat, 0)));
  EXPECT_TRUE(test::is_reddish({200, 30, 30}));
  EXPECT_TRUE(test::is_reddish({204, 121, 167})) << "pink";
  for (const std::array<std::uint8_t, 3> other :
       {std::array<std::uint8_t, 3>{230, 159, 0}, {0, 158, 115}, {90, 90, 90}})
    EXPECT_FALSE(test::is_reddish(other));
}

TEST(ViewerInspect, TheDifferenceIsThatOfTheFarthestChannelWithoutASign) {
  const Values a{.width = 1, .height = 2, .channels = 2, .numbers = {1, 2, 3, 4}};
  const Values b{.width = 1, .height = 2, .channels = 2, .numbers = {4, 2, 1, 4.5f}};
  for (const Values& values : {difference(a, b), difference(b, a)}) {
    EXPECT_EQ(values.numbers, (std::vector<float>{3, 2}));
    EXPECT_EQ(values.height, 2);
    EXPECT_EQ(values.channels, 1);
  }
}

class ViewerCursor : public testing::Test {
 protected:
  // Where the window shows a point of the picture, from the upper left, as glsl/viewer/present.frag computes it: `part`
  // 0 is the window or its left half, 1 its right half.
  static glm::vec2 shown_at(const viewer::PresentInputs& inputs, const glm::vec2& point, int part, int parts) {
    const auto width = static_cast<float>(inputs.window_size.x) / static_cast<float>(parts);
    const glm::vec2 middle(width * (static_cast<float>(part) + 0.5f), static_cast<float>(inputs.window_size.y) * 0.5f);
    return middle + (point - inputs.zoom.center * glm::vec2(inputs.picture_size)) * inputs.zoom.factor;
  }

  gl::Texture picture_;
};

TEST_F(ViewerCursor, ThePixelUnderTheCursorIsTheOneThatIsShownThere) {
  for (const viewer::CompareMode how : {viewer::CompareMode::a, viewer::CompareMode::b, viewer::CompareMode::wipe,
                                        viewer::CompareMode::side_by_side, viewer::CompareMode::difference}) {
    const int parts = how == viewer::CompareMode::side_by_side ? 2 : 1;
    for (const float factor : {1.0f, 0.5f, 3.0f, 16.0f}) {
      viewer::PresentInputs inputs{.a = &picture_, .b = &picture_, .picture_size = {40, 30}, .window_size = {321, 200}};
      inputs.comparison.on = true;
      inputs.comparison.how = how;
      inputs.zoom = {.factor = factor, .center = {0.3f, 0.6f}};
      int seen = 0;
      for (int i = 0; i < 40 * 30 * parts; ++i) {
        const glm::ivec2 pixel(i % 40, i / 40 % 30);
        const int part = i / (40 * 30);
        const glm::vec2 at = shown_at(inputs, glm::vec2(pixel) + 0.5f, part, parts);
        const float left = 321.0f * static_cast<float>(part) / static_cast<float>(parts);
        if (at.x < left || at.x >= left + 321.0f / static_cast<float>(parts)) continue;
        ++seen;
        EXPECT_EQ(pixel_at(inputs, at), pixel) << pixel.x << ", " << pixel.y << " times " << factor;
      }
      EXPECT_GT(seen, 100 * parts);
    }
  }
}

TEST_F(ViewerCursor, BesideThePictureThereIsNone) {
  viewer::PresentInputs inputs{.a = &picture_, .picture_size = {40, 30}, .window_size = {100, 100}};
  for (const glm::vec2 beside : {glm::vec2(29.5f, 50), {70.5f, 50}, {50, 34.5f}, {50, 65.5f}, {-1e9f, 1e9f}})
    EXPECT_FALSE(pixel_at(inputs, beside)) << beside.x << ", " << beside.y;
  EXPECT_EQ(pixel_at(inputs, {30.5f, 35.5f}), glm::ivec2(0, 0));
  EXPECT_EQ(pixel_at(inputs, {69.5f, 64.5f}), glm::ivec2(39, 29));
}

TEST_F(ViewerCursor, WithoutASecondPictureThereIsNoSideBySide) {
  viewer::PresentInputs inputs{.a = &picture_, .picture_size = {100, 100}, .window_size = {100, 100}};
  inputs.comparison.how = viewer::CompareMode::side_by_side;
  inputs.comparison.on = true;
  EXPECT_EQ(pixel_at(inputs, {50.5f, 50.5f}), glm::ivec2(50, 50)) << "B is not drawn yet";
  inputs.b = &picture_;
  EXPECT_EQ(pixel_at(inputs, {25.5f, 50.5f}), glm::ivec2(50, 50));
  EXPECT_EQ(pixel_at(inputs, {75.5f, 50.5f}), glm::ivec2(50, 50));
  inputs.comparison.on = false;
  EXPECT_EQ(pixel_at(inputs, {50.5f, 50.5f}), glm::ivec2(50, 50));
}

}  // namespace
}  // namespace penumbra

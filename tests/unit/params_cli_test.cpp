#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cli/output_names.h"
#include "cli/usage.h"
#include "render/aov_picture.h"

namespace {

using penumbra::cli::OutputNames;
using penumbra::cli::UsageError;

TEST(Usage, NumbersAreReadWhole) {
  EXPECT_EQ(penumbra::cli::parse_number("--time", "1.5", 0, 10), 1.5);
  EXPECT_EQ(penumbra::cli::parse_number("--time", "+2e0", 0, 10), 2.0);
  for (const char* text :
       {"", " 1", "1 ", "1x", "nan", "inf", "-inf", "1e999", "0x10", "1,5", "--1", "+-1", "11", "-1"})
    EXPECT_THROW(penumbra::cli::parse_number("--time", text, 0, 10), UsageError) << text;
}

TEST(Usage, CountsAreWholeAndInRange) {
  EXPECT_EQ(penumbra::cli::parse_count("--threads", "4", 1, 16), 4);
  for (const char* text : {"", "4.0", "0", "17", "99999999999999999999", "four"})
    EXPECT_THROW(penumbra::cli::parse_count("--threads", text, 1, 16), UsageError) << text;
}

TEST(Usage, SizesHaveTwoSides) {
  const auto size = penumbra::cli::parse_size("--size", "640x360");
  EXPECT_EQ(size.width, 640);
  EXPECT_EQ(size.height, 360);
  for (const char* text : {"640", "640x", "x360", "640x360x1", "-640x360", "0x1", "16385x1", "640X360", "1e3x10"})
    EXPECT_THROW(penumbra::cli::parse_size("--size", text), UsageError) << text;
}

TEST(Usage, PointsHaveThreeCoordinates) {
  EXPECT_EQ(penumbra::cli::parse_point("--eye", "-1,2.5,1e3"), glm::vec3(-1, 2.5, 1000));
  for (const char* text : {"1,2", "1,2,3,4", "1,,3", "nan,0,0", "1e10,0,0", "1;2;3"})
    EXPECT_THROW(penumbra::cli::parse_point("--eye", text), UsageError) << text;
}

TEST(Usage, FramesRunForwards) {
  const auto range = penumbra::cli::parse_frames("--frames", "3:7");
  EXPECT_EQ(range.first, 3);
  EXPECT_EQ(range.count(), 5);
  for (const char* text : {"7:3", "3", "3:", "-1:2", "1:2:3", "1:1000000"})
    EXPECT_THROW(penumbra::cli::parse_frames("--frames", text), UsageError) << text;
}

TEST(Usage, DirectionsAreInDegrees) {
  const auto direction = penumbra::cli::parse_direction("--sun", "90,-45");
  EXPECT_FLOAT_EQ(direction.azimuth, 1.5707964f);
  EXPECT_FLOAT_EQ(direction.elevation, -0.78539819f);
  for (const char* text : {"10", "10,91", "361,10", "a,b"})
    EXPECT_THROW(penumbra::cli::parse_direction("--sun", text), UsageError) << text;
}

TEST(OutputNames, OnePictureKeepsItsName) {
  EXPECT_EQ(OutputNames("a#b/100%.png", false).picture(7), "a#b/100%.png");
  EXPECT_EQ(OutputNames("room#1.png", false).picture(7), "room#1.png");
  EXPECT_EQ(OutputNames("x.PNG", false).picture(0), "x.PNG");
  EXPECT_EQ(OutputNames("out/x.png", false).aov(0, "shadow"), "out/x.shadow.png");
  EXPECT_TRUE(OutputNames("x.exr", false).is_exr());
}

TEST(OutputNames, SequencesAreNumbered) {
  EXPECT_EQ(OutputNames("out/x.png", true).picture(7), "out/x_0007.png");
  EXPECT_EQ(OutputNames("x.png", true).picture(123456), "x_123456.png");
  EXPECT_EQ(OutputNames("a#b/x-###_y.png", true).picture(7), "a#b/x-007_y.png");
  EXPECT_EQ(OutputNames("x%06d.exr", true).picture(7), "x000007.exr");
  EXPECT_EQ(OutputNames("##.exr", true).picture(7), "07.exr");
  EXPECT_NO_THROW(OutputNames(std::string(100'000, '#') + ".exr", true));
  EXPECT_EQ(OutputNames("x%d.exr", true).picture(7), "x7.exr");
  EXPECT_EQ(OutputNames("x.png", true).aov(7, "depth"), "x_0007.depth.png");
}

TEST(OutputNames, RefuseOtherKindsAndBadPatterns) {
  for (const char* name : {"x", "x.jpg", "x.png.", ".png", "out/", "x.tar"})
    EXPECT_THROW(OutputNames(name, false), UsageError) << name;
  for (const char* name : {"x%s.png", "x%.png", "x%d%d.png", "x%12d.png", "x%n.png", "x#_#.png", "x#%d.png", "x#%.png"})
    EXPECT_THROW(OutputNames(name, true), UsageError) << name;
  for (const char* name : {"x##.png", "x####.exr", "x%d.png", "x%04d.png"})
    EXPECT_THROW(OutputNames(name, false), UsageError) << name;
}

TEST(AovPicture, ABlockBecomesWhatItsMeaningAsks) {
  using penumbra::render::reduced;
  using enum penumbra::render::Reduction;
  // Two pixels of 2 × 2 each, side by side.
  const std::vector<float> drawn{0, 1, 4, 4, 2, 3, 4, 8};
  EXPECT_EQ(reduced(drawn, 2, 1, 1, 2, mean), (std::vector<float>{1.5f, 5.0f}));
  EXPECT_EQ(reduced(drawn, 2, 1, 1, 2, mean_of_valid), (std::vector<float>{2.0f, 5.0f}));
  EXPECT_EQ(reduced(drawn, 2, 1, 1, 2, nearest_center), (std::vector<float>{3.0f, 8.0f}));
  EXPECT_EQ(reduced({0, 0, 0, 0}, 1, 1, 1, 2, mean_of_valid), std::vector<float>{0.0f});
  EXPECT_EQ(reduced(drawn, 4, 2, 1, 1, mean_of_valid), drawn);
}

TEST(AovPicture, DisplayBytesAreAveragedInLinearLight) {
  const auto black_and_white = [](int v) { return std::vector<std::uint8_t>(3, static_cast<std::uint8_t>(v)); };
  std::vector<std::uint8_t> rgb;
  for (const int v : {0, 255, 255, 0}) {
    const auto pixel = black_and_white(v);
    rgb.insert(rgb.end(), pixel.begin(), pixel.end());
  }
  // Half the light is sRGB 188, not 128.
  EXPECT_EQ(penumbra::render::display_bytes(rgb, 1, 1, 2).pixels, std::vector<std::uint8_t>(3, 188));
  EXPECT_EQ(penumbra::render::display_bytes(rgb, 2, 2, 1).pixels, rgb);
}

TEST(AovPicture, EveryByteSurvivesTheAverageOfEquals) {
  for (int v = 0; v < 256; ++v) {
    const std::vector<std::uint8_t> block(12, static_cast<std::uint8_t>(v));
    EXPECT_EQ(penumbra::render::display_bytes(block, 1, 1, 2).pixels[0], v);
  }
}

TEST(AovPicture, AovsAreShownByTheirMeaning) {
  EXPECT_EQ(penumbra::render::aov_bytes("shadow", 1, {0.0f, 0.5f, 1.0f}).pixels,
            (std::vector<std::uint8_t>{0, 128, 255}));
  EXPECT_EQ(penumbra::render::aov_bytes("normal", 3, {0, 1, -1}).pixels, (std::vector<std::uint8_t>{128, 255, 0}));
  EXPECT_EQ(penumbra::render::aov_bytes("penumbra", 1, {0, 1, 4}).pixels, (std::vector<std::uint8_t>{0, 64, 255}));
  EXPECT_EQ(penumbra::render::aov_bytes("motion", 2, {0, -2}).pixels, (std::vector<std::uint8_t>{128, 0, 128}));
  const auto depth = penumbra::render::aov_bytes("depth", 1, {1, 2, 4, 0}).pixels;
  EXPECT_TRUE(depth[0] > depth[1] && depth[1] > depth[2] && depth[3] == 0);
  EXPECT_EQ(penumbra::render::aov_bytes("cascade", 1, {0, 1}).channels, 3);
}

}  // namespace

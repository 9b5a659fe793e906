// The width of penumbrae, measured on ramps whose width is known.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "metrics/penumbra_width.h"
#include "support/pictures.h"

namespace penumbra::metrics {
namespace {

using test::Grey;
using test::ramp;

TEST(PenumbraWidth, OfRampsAtAnyAngle) {
  for (const double degrees : {0.0, 17.0, 45.0, 90.0, 133.0, 200.0, 270.0, 301.0}) {
    const PenumbraWidth wider = penumbra_width(ramp(120, degrees, 30), ramp(120, degrees, 20));
    EXPECT_NEAR(wider.relative, 0.5, 0.015) << degrees;
    EXPECT_NEAR(wider.relative_bias, 0.5, 0.015) << degrees;
    const PenumbraWidth narrower = penumbra_width(ramp(120, degrees, 10), ramp(120, degrees, 20));
    EXPECT_NEAR(narrower.relative, 0.5, 0.015) << degrees;
    EXPECT_NEAR(narrower.relative_bias, -0.5, 0.015) << degrees;
    EXPECT_GT(narrower.measured, 1000u) << degrees;
  }
}

TEST(PenumbraWidth, IsNotTheShadowsPlace) {
  const Grey reference = ramp(100, 0, 20);
  const Grey moved(100, 100, [&](int x, int y) {
    return reference.pixels[static_cast<std::size_t>(y * 100 + std::clamp(x + 15, 0, 99))];
  });
  const PenumbraWidth width = penumbra_width(moved, reference);
  EXPECT_NEAR(width.relative, 0, 0.01) << "the same penumbra, 15 pixels farther";
  EXPECT_EQ(width.lost, 0u);
}

TEST(PenumbraWidth, OfAHardShadowIsUnderAPixel) {
  const Grey hard(100, 100, [](int x, int) { return x < 50 ? 0 : 1; });
  const PenumbraWidth width = penumbra_width(hard, ramp(100, 0, 20));
  EXPECT_NEAR(width.relative, (16 - 0.8) / 16, 0.004) << "0.8 pixels, where the ramp has 0.8 of 20";
  EXPECT_EQ(penumbra_width(hard, hard).measured, 0u) << "no reference in the penumbra";
  EXPECT_TRUE(std::isnan(penumbra_width(hard, hard).relative));
}

TEST(PenumbraWidth, OfARoundShadow) {
  const auto round = [](double width) {
    return Grey(160, 160, [=](int x, int y) {
      return std::clamp(0.5 + (std::hypot(x - 79.5, y - 79.5) - 45) / width, 0.0, 1.0);
    });
  };
  EXPECT_NEAR(penumbra_width(round(24), round(16)).relative_bias, 0.5, 0.01);
}

TEST(PenumbraWidth, CountsWhatTheTestLost) {
  const Grey reference = ramp(100, 0, 20), lit(100, 100, 1.0f);
  const PenumbraWidth width = penumbra_width(lit, reference);
  EXPECT_EQ(width.measured, 0u);
  EXPECT_GT(width.lost, 1000u);
  EXPECT_EQ(width.lost_share(), 1);
  EXPECT_TRUE(std::isnan(width.relative));
  EXPECT_EQ(penumbra_width(reference, reference).lost_share(), 0);
  EXPECT_TRUE(std::isnan(penumbra_width(lit, lit).lost_share())) << "nothing to lose";
  Grey broken = reference;
  for (int y = 0; y < 100; ++y) broken.at(50, y) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_GT(penumbra_width(broken, reference).lost, 500u);
}

TEST(PenumbraWidth, LinesEndAtWhatIsNoReceiver) {
  const Grey reference = ramp(100, 0, 20), wider = ramp(100, 0, 40);
  std::vector<std::uint8_t> receivers(reference.pixels.size(), 1);
  for (std::size_t y = 0; y < 100; ++y) receivers[y * 100 + 55] = 0;  // before 0.9 is reached
  EXPECT_EQ(penumbra_width(wider, reference, receivers).measured, 0u);
  for (std::size_t y = 0; y < 100; ++y) {
    receivers[y * 100 + 55] = 1;
    receivers[y * 100 + 60] = 0;  // between 0.9 of the reference and that of the test
  }
  EXPECT_EQ(penumbra_width(wider, reference, receivers).measured, 0u);
  EXPECT_GT(penumbra_width(wider, reference, receivers).lost, 1000u);
  EXPECT_GT(penumbra_width(reference, reference, receivers).measured, 1000u);
}

// Rows are lighter and darker by turns, which leaves the width along a row what it is but tilts the gradient by up to
// 39 degrees where nothing smooths it. The test's edge is at 20 degrees to the reference's.
TEST(PenumbraWidth, LinesFollowTheSmoothedReference) {
  const Grey even = ramp(120, 0, 20), tilted = ramp(120, 20, 20);
  const Grey rippled(120, 120, [&](int x, int y) {
    const double ripple = y % 3 == 1 ? 0.04 : y % 3 == 2 ? -0.04 : 0;
    return even.pixels[static_cast<std::size_t>(y * 120 + x)] + ripple;
  });
  const double exact = 1 / std::cos(20 * std::numbers::pi / 180) - 1;
  EXPECT_NEAR(penumbra_width(tilted, even).relative, exact, 0.001);
  EXPECT_NEAR(penumbra_width(tilted, rippled).relative, exact, 0.02);
}

// All rows are alike, or all columns.
TEST(PenumbraWidth, OfPixelsAtTheBorderIsThatOfTheOthers) {
  for (const double degrees : {0.0, 90.0, 180.0, 270.0}) {
    const PenumbraWidth width = penumbra_width(ramp(60, degrees, 30), ramp(60, degrees, 20));
    EXPECT_EQ(width.measured, 60u * 20) << degrees;
    EXPECT_EQ(width.lost, 0u) << degrees;
  }
}

TEST(PenumbraWidth, OfTinyAndEmptyPictures) {
  const Grey empty(0, 0, 0.0f), one(1, 1, 0.5f);
  for (const Grey& picture : {empty, one}) {
    EXPECT_EQ(penumbra_width(picture, picture).measured, 0u);
    EXPECT_TRUE(std::isnan(penumbra_width(picture, picture).relative));
  }
  const std::vector<float> rgb(3);
  EXPECT_THROW(penumbra_width({1, 1, rgb, 3}, {1, 1, rgb, 3}), Error);
}

}  // namespace
}  // namespace penumbra::metrics

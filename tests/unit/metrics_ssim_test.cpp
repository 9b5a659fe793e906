// SSIM compared with a direct evaluation of the paper's formula, and known properties of it.

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "metrics/ssim.h"
#include "support/pictures.h"

namespace penumbra::metrics {
namespace {

using test::Grey;

constexpr double c1 = 0.0001, c2 = 0.0009;

Grey pattern(int seed) {
  return {23, 17, [=](int x, int y) { return ((x * 7919 + y * 104729 + x * y * seed) % 101) / 100.0; }};
}

// The formula for one pixel, in double precision, with a window that is cut off at the border.
double ssim_at(const Grey& a, const Grey& b, int px, int py, const std::vector<std::uint8_t>& receivers) {
  double w = 0, mx = 0, my = 0, xx = 0, yy = 0, xy = 0;
  for (int y = std::max(py - 5, 0); y <= std::min(py + 5, a.height - 1); ++y) {
    for (int x = std::max(px - 5, 0); x <= std::min(px + 5, a.width - 1); ++x) {
      const auto i = static_cast<std::size_t>(y * a.width + x);
      if (!is_receiver(receivers, i)) continue;
      const double weight = std::exp(-((x - px) * (x - px) + (y - py) * (y - py)) / (2 * 1.5 * 1.5));
      w += weight;
      mx += weight * a.pixels[i];
      my += weight * b.pixels[i];
      xx += weight * a.pixels[i] * a.pixels[i];
      yy += weight * b.pixels[i] * b.pixels[i];
      xy += weight * a.pixels[i] * b.pixels[i];
    }
  }
  mx /= w, my /= w;
  const double vx = xx / w - mx * mx, vy = yy / w - my * my, vxy = xy / w - mx * my;
  return (2 * mx * my + c1) * (2 * vxy + c2) / ((mx * mx + my * my + c1) * (vx + vy + c2));
}

double ssim_of(const Grey& a, const Grey& b, const std::vector<std::uint8_t>& receivers) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      if (!is_receiver(receivers, static_cast<std::size_t>(y * a.width + x))) continue;
      sum += ssim_at(a, b, x, y, receivers);
      ++count;
    }
  }
  return sum / count;
}

TEST(Ssim, IsTheFormulaUnderTheWindow) {
  const Grey a = pattern(3), b = pattern(5);
  EXPECT_NEAR(ssim(a, b), ssim_of(a, b, {}), 1e-5);
  std::vector<std::uint8_t> receivers(a.pixels.size());
  for (std::size_t i = 0; i < receivers.size(); ++i) receivers[i] = i % 7 < 4 ? 1 : 0;
  EXPECT_NEAR(ssim(a, b, receivers), ssim_of(a, b, receivers), 1e-5);
}

TEST(Ssim, OfConstantPicturesComparesTheirMeans) {
  const Grey a(20, 20, 0.4f), b(20, 20, 0.6f);
  EXPECT_NEAR(ssim(a, b), (2 * 0.4 * 0.6 + c1) / (0.16 + 0.36 + c1), 1e-5);
}

TEST(Ssim, OfEqualPicturesIsOneAndOfInvertedOnesNegative) {
  const Grey a = pattern(3), inverted(a.width, a.height, [&](int x, int y) {
    return 1 - a.pixels[static_cast<std::size_t>(y * a.width + x)];
  });
  EXPECT_NEAR(ssim(a, a), 1, 1e-6);
  EXPECT_LT(ssim(inverted, a), -0.5);
}

TEST(Ssim, OfNearlyEqualPicturesIsNotOverOne) {
  for (int step = 0; step < 60; ++step) {
    const auto shade = [=](int x, int y) { return step / 60.0 + 1e-4 * ((x * 7 + y * 3) % 5); };
    const Grey a(17, 13, shade), b(17, 13, [&](int x, int y) { return shade(x, y) + 1e-7; });
    for (const Grey& other : {a, b}) {
      EXPECT_LE(ssim(other, a), 1) << step;
      EXPECT_NEAR(ssim(other, a), 1, 1e-4) << step;
    }
  }
}

TEST(Ssim, OfHugeValuesIsANumber) {
  const Grey a = pattern(3);
  for (const float huge : {1e7f, 1e20f, std::numeric_limits<float>::max(), -std::numeric_limits<float>::max()}) {
    Grey one = a;
    one.at(11, 8) = huge;
    EXPECT_GT(ssim(one, a), -1) << huge;
    EXPECT_LT(ssim(one, a), 0.9) << huge;
    EXPECT_NEAR(ssim(Grey(a.width, a.height, huge), a), 0, 1e-3) << huge;
  }
}

TEST(Ssim, IgnoresWhatIsNoReceiver) {
  const Grey a = pattern(3);
  Grey b = a;
  std::vector<std::uint8_t> receivers(a.pixels.size(), 1);
  b.at(11, 8) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_LT(ssim(b, a), 0.999) << "no number is an error";
  receivers[8 * 23 + 11] = 0;
  EXPECT_NEAR(ssim(b, a, receivers), 1, 1e-6);
}

TEST(Ssim, TakesTheLumaOfColours) {
  std::vector<float> rgb, changed;
  Grey luma(12, 12, 0.0f), changed_luma(12, 12, 0.0f);
  for (std::size_t i = 0; i < 144; ++i) {
    const float r = static_cast<float>(i % 5) / 5, g = static_cast<float>(i % 7) / 7, b = static_cast<float>(i % 3) / 3;
    rgb.insert(rgb.end(), {r, g, b});
    changed.insert(changed.end(), {g, g, r});
    luma.pixels[i] = 0.2126f * r + 0.7152f * g + 0.0722f * b;
    changed_luma.pixels[i] = 0.2126f * g + 0.7152f * g + 0.0722f * r;
  }
  EXPECT_NEAR(ssim({12, 12, changed, 3}, {12, 12, rgb, 3}), ssim(changed_luma, luma), 1e-6);
}

TEST(Ssim, OfTinyAndEmptyPictures) {
  const Grey one(1, 1, 0.4f), other(1, 1, 0.6f), empty(0, 0, 0.0f);
  EXPECT_NEAR(ssim(one, other), (2 * 0.4 * 0.6 + c1) / (0.16 + 0.36 + c1), 1e-5);
  EXPECT_TRUE(std::isnan(ssim(empty, empty)));
  const std::vector<float> two(2);
  EXPECT_THROW(ssim({1, 1, two, 2}, {1, 1, two, 2}), Error);
}

}  // namespace
}  // namespace penumbra::metrics

// The bounds that filtered maps give, against distributions of which the exact share above a value is known.

#include "lib/prefilter.glsl"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace penumbra::glsl {
namespace {

struct Mass {
  double at = 0, share = 0;
};
using Distribution = std::vector<Mass>;

Distribution random_distribution(std::mt19937& random, int points) {
  std::uniform_real_distribution<double> any(0.05, 1);
  Distribution masses;
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    masses.push_back({2 * any(random) - 1, any(random)});
    sum += masses.back().share;
  }
  for (Mass& mass : masses) mass.share /= sum;
  return masses;
}

vec4 moments_of(const Distribution& masses) {
  std::array<double, 4> sums{};
  for (const Mass& mass : masses) {
    double power = 1;
    for (double& sum : sums) sum += mass.share * (power *= mass.at);
  }
  return {sums[0], sums[1], sums[2], sums[3]};
}

double share_above(const Distribution& masses, double value) {
  double share = 0;
  for (const Mass& mass : masses) share += mass.at >= value ? mass.share : 0;
  return share;
}

TEST(Prefilter, BoundsAreNeverBelowTheShareOfAnyDistribution) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> values(-1, 1);
  for (int i = 0; i < 20000; ++i) {
    const Distribution masses = random_distribution(random, 3 + i % 6);
    const vec4 b = moments_of(masses);
    const float value = values(random);
    const double share = share_above(masses, static_cast<double>(value));
    EXPECT_GE(chebyshev_bound(value, b.x, b.y - b.x * b.x), share - 1e-4);
    EXPECT_GE(hamburger_bound(value, b), share - 0.01);
  }
}

TEST(Prefilter, ChebyshevsBoundIsAShareForEveryVariance) {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  EXPECT_EQ(chebyshev_bound(1e19f, 0, infinite), 1);
  EXPECT_EQ(chebyshev_bound(1e19f, 0, 0), 0);
  EXPECT_EQ(chebyshev_bound(1e-25f, 0, 0), 1);
  EXPECT_FLOAT_EQ(chebyshev_bound(2, 1, 3), 0.75f);
}

TEST(Prefilter, TwoDepthsGiveTheExactShareForAReceiverAtTheFartherOne) {
  std::mt19937 random(8);
  for (int i = 0; i < 2000; ++i) {
    Distribution masses = random_distribution(random, 2);
    std::ranges::sort(masses, {}, &Mass::at);
    if (masses[1].at - masses[0].at < 0.05) continue;
    const vec4 b = moments_of(masses);
    const auto value = static_cast<float>(masses[1].at);
    EXPECT_NEAR(chebyshev_bound(value, b.x, b.y - b.x * b.x), masses[1].share, 0.01);
  }
}

// Chebyshev's bound knows two moments, and leaves light between the two casters; four moments leave none.
TEST(Prefilter, ThreeDepthsGiveTheExactShareByFourMomentsAlone) {
  std::mt19937 random(9);
  double worst_of_two = 0;
  for (int i = 0; i < 2000; ++i) {
    Distribution masses = random_distribution(random, 3);
    std::ranges::sort(masses, {}, &Mass::at);
    if (masses[1].at - masses[0].at < 0.2 || masses[2].at - masses[1].at < 0.2) continue;
    const vec4 b = moments_of(masses);
    const auto value = static_cast<float>(masses[2].at);
    EXPECT_NEAR(hamburger_bound(value, b), masses[2].share, 0.01);
    worst_of_two = std::max(worst_of_two, chebyshev_bound(value, b.x, b.y - b.x * b.x) - masses[2].share);
  }
  EXPECT_GT(worst_of_two, 0.2);
}

TEST(Prefilter, PackedMomentsFillTheUnitRangeAndComeBack) {
  std::mt19937 random(10);
  vec4 least(1), greatest(0);
  for (int i = 0; i < 20000; ++i) {
    const vec4 b = moments_of(random_distribution(random, 1 + i % 3));
    const vec4 stored = packed_moments(b);
    least = min(least, stored);
    greatest = max(greatest, stored);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(unpacked_moments(stored)[k], b[k], 1e-5);
  }
  for (int k = 0; k < 4; ++k) {
    EXPECT_GE(least[k], 0);
    EXPECT_LE(least[k], 0.05);
    EXPECT_LE(greatest[k], 1);
    EXPECT_GE(greatest[k], 0.95);
  }
}

TEST(Prefilter, TheSquareOfAWarpFitsItsFormat) {
  EXPECT_LT(std::exp(2 * static_cast<double>(largest_exponent(16))), 65504);
  EXPECT_LT(100 * std::exp(2 * static_cast<double>(largest_exponent(32))),
            static_cast<double>(std::numeric_limits<float>::max()));
}

TEST(Prefilter, TheKernelSpansFourToEightTexelsOfItsLevel) {
  for (float radius = 0.1f; radius < 1000; radius *= 1.07f) {
    const int level = kernel_level(radius, 12);
    const float texels = radius / std::exp2(static_cast<float>(level));
    EXPECT_LT(texels, 8);
    EXPECT_TRUE(level == 0 || texels >= 4) << radius;
  }
  EXPECT_EQ(kernel_level(1e6f, 5), 4);
  EXPECT_FLOAT_EQ(kernel_weight(1), 0);
  EXPECT_FLOAT_EQ(kernel_weight(2), 0);
}

TEST(Prefilter, CuttingBleedingKeepsFullLightAndFullShadow) {
  EXPECT_EQ(without_bleeding(1, 0.3f), 1);
  EXPECT_EQ(without_bleeding(0.3f, 0.3f), 0);
  EXPECT_EQ(without_bleeding(0.1f, 0.3f), 0);
}

}  // namespace
}  // namespace penumbra::glsl

#include "shadow/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <utility>

namespace penumbra::shadow {
namespace {

using Points = std::vector<glm::vec2>;

TEST(Sampling, RadicalInverseMirrorsDigits) {
  EXPECT_EQ(radical_inverse(2, 0), 0);
  EXPECT_EQ(radical_inverse(2, 1), 0.5);
  EXPECT_EQ(radical_inverse(2, 6), 0.375);
  EXPECT_NEAR(radical_inverse(3, 5), 2.0 / 3 + 1.0 / 9, 1e-15) << "12 in base 3";
}

TEST(Sampling, AllPatternsGiveDistinctPointsOfTheSquareAndTheDisc) {
  for (const std::string& pattern : pattern_names()) {
    for (const int count : {1, 2, 7, 16, 64, 256}) {
      std::set<std::pair<float, float>> seen;
      for (const glm::vec2& u : square_points(pattern, count)) {
        EXPECT_TRUE(u.x >= 0 && u.y >= 0 && u.x < 1 && u.y < 1) << pattern << " " << u.x << " " << u.y;
        seen.emplace(u.x, u.y);
      }
      EXPECT_EQ(static_cast<int>(seen.size()), count) << pattern;
      const Points disc = disc_points(pattern, count);
      ASSERT_EQ(static_cast<int>(disc.size()), count) << pattern;
      for (const glm::vec2& p : disc) EXPECT_LE(glm::length(p), 1.0001f) << pattern;
    }
  }
}

TEST(Sampling, DiscPointsFillEqualAreasEqually) {
  for (const std::string& pattern : pattern_names()) {
    int inner = 0;
    for (const glm::vec2& p : disc_points(pattern, 256)) inner += glm::length(p) < std::sqrt(0.5f) ? 1 : 0;
    // Random points scatter; a grid's come in rings of up to 44.
    EXPECT_NEAR(inner, 128, pattern == "uniform" ? 32 : pattern == "regular" ? 22 : 12) << pattern;
  }
}

TEST(Sampling, StarDiscrepancyOfKnownSets) {
  EXPECT_NEAR(star_discrepancy(Points{{0.5f, 0.5f}}), 0.75, 1e-9);
  EXPECT_NEAR(star_discrepancy(Points{{0, 0}}), 1, 1e-9);
  EXPECT_NEAR(star_discrepancy(Points{{0, 0}, {0.5f, 0.5f}}), 0.75, 1e-9);
  // Of the centres of m² cells: the closed box that just holds all of them is the worst.
  for (const int m : {2, 4, 16}) {
    EXPECT_NEAR(star_discrepancy(square_points("regular", m * m)), 1.0 / m - 0.25 / (m * m), 1e-6) << m;
  }
}

TEST(Sampling, LowDiscrepancySetsKeepTheirBound) {
  for (const int count : {16, 64, 256}) {
    // Niederreiter 1992, theorem 3.8, for base 2, and a point of Halton's set costs a little more.
    const double bound = (0.5 * std::log2(count) + 1.5) / count;
    EXPECT_LE(star_discrepancy(square_points("hammersley", count)), bound) << count;
    EXPECT_LE(star_discrepancy(square_points("halton", count)), 1.5 * bound) << count;
    EXPECT_GT(star_discrepancy(square_points("uniform", count)), bound) << count;
  }
}

TEST(Sampling, PoissonPointsKeepTheirDistanceOnTheTorus) {
  for (const int count : {8, 16, 64, 256}) {
    const double packed = std::sqrt(2 / (std::sqrt(3.0) * count));
    for (const std::uint64_t seed : {0, 1, 2}) {
      EXPECT_GE(least_toroidal_distance(square_points("poisson", count, seed)), 0.7 * packed) << count;
      EXPECT_GE(least_toroidal_distance(square_points("poisson_hierarchical", count, seed)), 0.55 * packed) << count;
    }
    if (count < 16) continue;
    EXPECT_LT(least_toroidal_distance(square_points("uniform", count)), 0.4 * packed) << count;
  }
}

TEST(Sampling, EveryPrefixOfTheHierarchicalSetIsWellSpread) {
  const Points all = square_points("poisson_hierarchical", 64);
  double worst_poisson = 1;
  const Points flat = square_points("poisson", 64);
  for (std::size_t count = 2; count <= 64; ++count) {
    const double packed = std::sqrt(2 / (std::sqrt(3.0) * static_cast<double>(count)));
    EXPECT_GE(least_toroidal_distance(std::span(all).first(count)), 0.55 * packed) << count;
    worst_poisson = std::min(worst_poisson, least_toroidal_distance(std::span(flat).first(count)) / packed);
    if (count == 16) {
      EXPECT_EQ(Points(all.begin(), all.begin() + 16), square_points("poisson_hierarchical", 16));
    }
  }
  EXPECT_LT(worst_poisson, 0.4) << "a plain Poisson set has no such order";
}

TEST(Sampling, SeedsVaryRandomPatternsAlone) {
  for (const std::string& pattern : pattern_names()) {
    const bool random = pattern == "uniform" || pattern.starts_with("poisson");
    EXPECT_EQ(square_points(pattern, 16, 1) != square_points(pattern, 16, 2), random) << pattern;
    EXPECT_EQ(square_points(pattern, 16, 1), square_points(pattern, 16, 1)) << pattern;
  }
}

}  // namespace
}  // namespace penumbra::shadow

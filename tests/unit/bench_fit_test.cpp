#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "bench/linear_fit.h"
#include "bench/statistics.h"
#include "core/error.h"

namespace penumbra::test {
namespace {

using bench::fit_linear;
using bench::LinearFit;

// The sixteen points of the sweep over taps.
std::vector<std::vector<double>> taps() {
  std::vector<std::vector<double>> points;
  for (const double blocker : {8.0, 32.0, 64.0, 128.0}) {
    for (const double filter : {8.0, 32.0, 64.0, 128.0}) points.push_back({blocker, filter});
  }
  return points;
}

TEST(LinearFit, FindsAnExactCostModel) {
  const std::vector<std::vector<double>> xs = taps();
  std::vector<double> ys;
  for (const auto& x : xs) ys.push_back(0.25 + 0.011 * x[0] + 0.0042 * x[1]);
  const LinearFit fit = fit_linear(xs, ys);
  EXPECT_NEAR(fit.constant, 0.25, 1e-12);
  ASSERT_EQ(fit.slopes.size(), 2U);
  EXPECT_NEAR(fit.slopes[0], 0.011, 1e-13);
  EXPECT_NEAR(fit.slopes[1], 0.0042, 1e-13);
  EXPECT_NEAR(fit.r_squared, 1.0, 1e-12);
}

// Tests the definition: other coefficients never give a smaller sum of squares, and R² follows from that sum.
TEST(LinearFit, OfNoisyTimesIsTheLeastSquaresOne) {
  const std::vector<std::vector<double>> xs = taps();
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.1);
  std::vector<double> ys;
  for (const auto& x : xs) ys.push_back(1.0 + 0.02 * x[0] + 0.01 * x[1] + noise(random));
  const LinearFit fit = fit_linear(xs, ys);
  const auto residual = [&](double a, double b, double c) {
    double sum = 0;
    for (std::size_t i = 0; i < xs.size(); ++i) sum += std::pow(ys[i] - a - b * xs[i][0] - c * xs[i][1], 2.0);
    return sum;
  };
  const double best = residual(fit.constant, fit.slopes[0], fit.slopes[1]);
  for (const double step : {-1e-3, 1e-3}) {
    EXPECT_GT(residual(fit.constant + step, fit.slopes[0], fit.slopes[1]), best);
    EXPECT_GT(residual(fit.constant, fit.slopes[0] + step, fit.slopes[1]), best);
    EXPECT_GT(residual(fit.constant, fit.slopes[0], fit.slopes[1] + step), best);
  }
  double mean = 0, all = 0;
  for (const double y : ys) mean += y / static_cast<double>(ys.size());
  for (const double y : ys) all += (y - mean) * (y - mean);
  EXPECT_NEAR(fit.r_squared, 1.0 - best / all, 1e-12);
  EXPECT_NEAR(fit.slopes[0], 0.02, 0.002);
  EXPECT_NEAR(fit.slopes[1], 0.01, 0.002);
}

// Coordinates of very different size, such as millions of texels and single taps.
TEST(LinearFit, HoldsForCoordinatesOfAnyScale) {
  const std::vector<std::vector<double>> xs{{1e7, 1e-6}, {2e7, 5e-6}, {4e7, 3e-6}, {9e7, 8e-6}};
  std::vector<double> ys;
  for (const auto& x : xs) ys.push_back(3.0 + 1e-7 * x[0] + 1e5 * x[1]);
  const LinearFit fit = fit_linear(xs, ys);
  EXPECT_NEAR(fit.constant, 3.0, 1e-9);
  EXPECT_NEAR(fit.slopes[0], 1e-7, 1e-15);
  EXPECT_NEAR(fit.slopes[1], 1e5, 1e-3);
}

TEST(LinearFit, RefusesPointsThatSettleNothing) {
  const std::vector<double> two{1, 2}, three{1, 2, 3};
  EXPECT_THROW(fit_linear(std::vector<std::vector<double>>{}, {}), Error);
  EXPECT_THROW(fit_linear(std::vector<std::vector<double>>{{1, 1}, {2, 3}}, two), Error);
  EXPECT_THROW(fit_linear(std::vector<std::vector<double>>{{1, 2}, {2, 4}, {3, 6}}, three), Error);  // in a line
  EXPECT_THROW(fit_linear(std::vector<std::vector<double>>{{5}, {5}, {5}}, three), Error);
}

TEST(Statistics, MedianLiesInTheMiddle) {
  const bench::Summary odd = bench::summary_of({5, 1, 3}), even = bench::summary_of({4, 1, 3, 100});
  EXPECT_EQ(odd.median, 3);
  EXPECT_EQ(odd.min, 1);
  EXPECT_EQ(odd.max, 5);
  EXPECT_EQ(odd.count, 3U);
  EXPECT_EQ(even.median, 3.5);
  EXPECT_EQ(bench::summary_of({}).count, 0U);
}

// A machine that becomes twice as slow halfway through slows both down alike.
TEST(Statistics, PairedRatioIsFreeOfDrift) {
  const std::vector<double> first{10, 10, 20, 20, 40}, second{5, 5, 10, 10, 20}, none(5, 0.0);
  EXPECT_DOUBLE_EQ(bench::paired_ratio(second, first), 0.5);
  EXPECT_EQ(bench::paired_ratio(first, none), 0);
}

}  // namespace
}  // namespace penumbra::test

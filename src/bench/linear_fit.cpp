#include "bench/linear_fit.h"

#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/error.h"

namespace penumbra::bench {

namespace {

using Rows = std::vector<std::vector<double>>;

// Gaussian elimination with pivots: `rows` is a square matrix and, as a last column, the right-hand side. The matrix
// has 1 on its diagonal, so that a pivot is small if its row nearly depends on the others.
std::vector<double> solved(Rows rows) {
  constexpr double least_pivot = 1e-9;
  const std::size_t n = rows.size();
  for (std::size_t column = 0; column < n; ++column) {
    std::size_t pivot = column;
    for (std::size_t i = column + 1; i < n; ++i) {
      if (std::abs(rows[i][column]) > std::abs(rows[pivot][column])) pivot = i;
    }
    if (!(std::abs(rows[pivot][column]) > least_pivot)) fail("the points do not determine a linear fit");
    std::swap(rows[column], rows[pivot]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == column) continue;
      const double factor = rows[i][column] / rows[column][column];
      for (std::size_t j = column; j <= n; ++j) rows[i][j] -= factor * rows[column][j];
    }
  }
  std::vector<double> solution(n);
  for (std::size_t i = 0; i < n; ++i) solution[i] = rows[i][n] / rows[i][i];
  return solution;
}

double mean_of(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// One coordinate of all points, with its mean subtracted and scaled to unit length: taps and texels differ by powers of
// ten, and the normal equations would square that ratio.
struct Coordinate {
  std::vector<double> values;
  double mean = 0, length = 0;
};

Coordinate coordinate_of(std::span<const std::vector<double>> xs, std::size_t index) {
  Coordinate coordinate;
  for (const std::vector<double>& x : xs) coordinate.values.push_back(x.at(index));
  coordinate.mean = mean_of(coordinate.values);
  for (double& value : coordinate.values) {
    value -= coordinate.mean;
    coordinate.length += value * value;
  }
  coordinate.length = std::sqrt(coordinate.length);
  if (!(coordinate.length > 0)) fail("the points do not determine a linear fit");
  for (double& value : coordinate.values) value /= coordinate.length;
  return coordinate;
}

double dot(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

double explained(const LinearFit& fit, std::span<const std::vector<double>> xs, std::span<const double> ys) {
  const double mean = mean_of(ys);
  double all = 0, left = 0;
  for (std::size_t i = 0; i < ys.size(); ++i) {
    const double error = ys[i] - fit.constant - dot(fit.slopes, xs[i]);
    left += error * error;
    all += (ys[i] - mean) * (ys[i] - mean);
  }
  return all > 0 ? 1.0 - left / all : 1.0;
}

}  // namespace

LinearFit fit_linear(std::span<const std::vector<double>> xs, std::span<const double> ys) {
  assert(xs.size() == ys.size());
  const std::size_t count = xs.empty() ? 0 : xs.front().size();
  if (xs.size() < count + 1 || count == 0) fail("{} points do not determine a linear fit", xs.size());
  std::vector<Coordinate> coordinates;
  for (std::size_t i = 0; i < count; ++i) coordinates.push_back(coordinate_of(xs, i));

  Rows rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (const Coordinate& other : coordinates) rows[i].push_back(dot(coordinates[i].values, other.values));
    rows[i].push_back(dot(coordinates[i].values, ys));
  }
  LinearFit fit{.constant = mean_of(ys), .slopes = solved(std::move(rows))};
  for (std::size_t i = 0; i < count; ++i) {
    fit.slopes[i] /= coordinates[i].length;
    fit.constant -= fit.slopes[i] * coordinates[i].mean;
  }
  fit.r_squared = explained(fit, xs, ys);
  return fit;
}

}  // namespace penumbra::bench

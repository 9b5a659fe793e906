#pragma once

#include <span>
#include <vector>

namespace penumbra::bench {

// y = constant + Σ slopes[i] · x[i], by least squares.
struct LinearFit {
  double constant = 0;
  std::vector<double> slopes;
  // The share of the variance of y that the fit explains: 1 for an exact fit, and if all y are equal.
  double r_squared = 0;
};

// Fits as many ys as xs; each of xs has the same number of coordinates. Throws Error if the points do not determine the
// coefficients: there are fewer points than coefficients, or all lie on a line or a plane.
LinearFit fit_linear(std::span<const std::vector<double>> xs, std::span<const double> ys);

}  // namespace penumbra::bench

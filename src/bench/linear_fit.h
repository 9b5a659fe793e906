#pragma once

#include <span>
#include <vector>

namespace penumbra::bench {

// y = constant + Σ slopes[i] · x[i], by least squares.
struct LinearFit {
  double constant = 0;
  std::vector<double> slopes;
  // Share of the variance of y that the fit explains: 1 for an exact one. 1 too where all y are the same.
  double r_squared = 0;
};

// Of as many ys as xs; each of xs has the same number of coordinates. Throws Error where the points do not settle the
// coefficients: fewer than those, or all in a line or a plane.
LinearFit fit_linear(std::span<const std::vector<double>> xs, std::span<const double> ys);

}  // namespace penumbra::bench

#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace penumbra::bench {

// A figure as reports write it, rounded to four decimals (0.1 µs for milliseconds), so that CSV and JSON agree.
double rounded(double value);

// A summary of measured times. All members are 0 if there are none.
struct Summary {
  double median = 0, min = 0, max = 0;
  std::size_t count = 0;
};

// The median as io::median_of() gives it.
Summary summary_of(std::vector<double> values);

// The median of values[i] / to[i]. If both are measured alternately, slow changes of the machine's speed cancel out.
// Pairs where to[i] is not positive are left out; returns 0 if none is left. Both must have the same length.
double paired_ratio(std::span<const double> values, std::span<const double> to);

}  // namespace penumbra::bench

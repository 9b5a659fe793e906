#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace penumbra::bench {

// A figure as reports write it, to tenths of a microsecond of milliseconds: CSV and JSON say the same.
double rounded(double value);

// What measured times have in common. All 0 where there are none.
struct Summary {
  double median = 0, min = 0, max = 0;
  std::size_t count = 0;
};

// Of an even number the median is the mean of the middle two.
Summary summary_of(std::vector<double> values);

// The median of values[i] / to[i]: what drifts while both are measured in turn falls out. Pairs with a 0 below are left
// out; 0 where none is left. Both are equally long.
double paired_ratio(std::span<const double> values, std::span<const double> to);

}  // namespace penumbra::bench

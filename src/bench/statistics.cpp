#include "bench/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace penumbra::bench {

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

Summary summary_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  const double median = values.size() % 2 != 0 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
  return {.median = median, .min = values.front(), .max = values.back(), .count = values.size()};
}

double paired_ratio(std::span<const double> values, std::span<const double> to) {
  assert(values.size() == to.size());
  std::vector<double> ratios;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (to[i] > 0) ratios.push_back(values[i] / to[i]);
  }
  return summary_of(std::move(ratios)).median;
}

}  // namespace penumbra::bench

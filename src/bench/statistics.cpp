#include "bench/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "io/median.h"

namespace penumbra::bench {

double rounded(double value) { return std::round(value * 1e4) / 1e4; }

Summary summary_of(std::vector<double> values) {
  if (values.empty()) return {};
  const auto [min, max] = std::ranges::minmax(values);
  const std::size_t count = values.size();
  return {.median = io::median_of(std::move(values)), .min = min, .max = max, .count = count};
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

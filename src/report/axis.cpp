#include "report/axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/number.h"

namespace penumbra::report {

namespace {

constexpr double margin = 0.06;  // share of the range, on both sides

// The smallest round step that is at least `rough`.
double round_step(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

std::vector<Tick> power_ticks(double low, double high, std::span<const double> factors) {
  std::vector<Tick> ticks;
  const int first = static_cast<int>(std::floor(std::log10(low))), last = static_cast<int>(std::ceil(std::log10(high)));
  for (int power = first; power <= last; ++power) {
    for (const double factor : factors) {
      const double value = factor * std::pow(10.0, power);
      if (value >= low * (1 - 1e-9) && value <= high * (1 + 1e-9)) ticks.push_back({value, significant(value, 3)});
    }
  }
  return ticks;
}

}  // namespace

std::vector<Tick> linear_ticks(double low, double high, int about) {
  if (!(high > low) || !std::isfinite(high - low)) return {{low, significant(low, 4)}};
  const double step = round_step((high - low) / std::max(about, 1));
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  const double most = std::max(std::abs(low), std::abs(high));
  std::vector<Tick> ticks;
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    const double value = i == 0 ? 0.0 : i * step;
    ticks.push_back({value, most >= 1e6 || decimals > 6 ? significant(value, 3) : fixed(value, decimals)});
  }
  return ticks;
}

std::vector<Tick> log_ticks(double low, double high) {
  static constexpr double one[] = {1}, three[] = {1, 2, 5};
  std::vector<Tick> ticks = power_ticks(low, high, one);
  if (ticks.size() < 3) ticks = power_ticks(low, high, three);
  if (ticks.size() < 3) ticks = linear_ticks(low, high, 6);
  return ticks;
}

Scale::Scale(const Axis& axis, std::span<const double> values, double from, double to)
    : log_(axis.log), from_(from), to_(to) {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
  for (const double value : values) {
    if (!shows(value)) continue;
    low = std::min(low, measure(value));
    high = std::max(high, measure(value));
  }
  if (low <= high) {
    const bool single = high - low < 1e-9 * std::max(std::abs(low), std::abs(high)) || low == high;
    const double room = single ? (log_ ? 0.3 : std::max(0.5 * std::abs(low), 0.5)) : margin * (high - low);
    low_ = low - room;
    high_ = high + room;
    // If no value is negative, the margin must not extend below 0.
    if (!log_ && low >= 0 && low_ < 0) low_ = 0;
  }
  ticks_ = log_ ? log_ticks(std::pow(10.0, low_), std::pow(10.0, high_)) : linear_ticks(low_, high_, 6);
}

bool Scale::shows(double value) const { return std::isfinite(value) && (!log_ || value > 0); }

double Scale::measure(double value) const { return log_ ? std::log10(value) : value; }

double Scale::at(double value) const { return from_ + (measure(value) - low_) / (high_ - low_) * (to_ - from_); }

}  // namespace penumbra::report

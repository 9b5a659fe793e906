#pragma once

#include <span>
#include <string>
#include <vector>

namespace penumbra::report {

// A quantity along one side of a plot.
struct Axis {
  std::string label;  // "cost of the shadow passes"
  std::string unit;   // "ms"; empty for none
  bool log = false;
};

struct Tick {
  double value;
  std::string label;
};

// Round values (1, 2 or 5 times a power of ten) from low to high, about `about` of them, labelled with as many digits
// as are needed to distinguish them.
std::vector<Tick> linear_ticks(double low, double high, int about);
// Powers of ten; if there are fewer than three, also their multiples by 2 and 5, and if there are still fewer than
// three, linear_ticks(). Both ends must be positive.
std::vector<Tick> log_ticks(double low, double high);

// Maps values of an axis to positions in a plot.
class Scale {
 public:
  // The scale covers all finite values that the axis can show, with a margin; position `from` is the low end, `to` the
  // high end. Without any such value it covers 0 to 1 (logarithmic: 1 to 10).
  Scale(const Axis& axis, std::span<const double> values, double from, double to);

  // Whether the axis can show it: finite, and positive where the axis is logarithmic.
  bool shows(double value) const;
  double at(double value) const;
  const std::vector<Tick>& ticks() const { return ticks_; }

 private:
  double measure(double value) const;

  bool log_;
  double low_ = 0, high_ = 1;  // in units of measure()
  double from_, to_;
  std::vector<Tick> ticks_;
};

}  // namespace penumbra::report

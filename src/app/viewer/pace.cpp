#include "app/viewer/pace.h"

#include <algorithm>

namespace penumbra::app {

Pace::Step Pace::next(double now, bool changed, bool busy, int frames, int wanted) {
  if (!software_) return {.draw = true, .divisor = 1};
  if (changed) {
    last_change_ = now;
    return {.draw = true, .divisor = divisor_};
  }
  const bool rests = now - last_change_ >= rest_seconds;
  return {.draw = rests && !busy && frames < wanted, .divisor = 1};
}

void Pace::drew(int divisor, double milliseconds) {
  // The full picture tells what a smaller one would take, roughly.
  const double expected = divisor == divisor_ ? milliseconds : milliseconds * divisor * divisor / divisor_ / divisor_;
  if (expected > slow_ms) divisor_ = std::min(divisor_ * 2, 8);
  if (expected < fast_ms) divisor_ = std::max(divisor_ / 2, 1);
}

}  // namespace penumbra::app

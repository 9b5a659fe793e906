#include "viewer/pace.h"

#include <algorithm>
#include <utility>

namespace penumbra::viewer {

Pace::Step Pace::next(double now, bool changed, bool busy, int frames, int wanted) {
  if (changed) {
    last_change_ = now;
    begun_ = false;
    return {.draw = true, .divisor = software_ ? divisor_ : 1};
  }
  const bool rests = now - last_change_ >= rest_seconds;
  if (!software_) return {.draw = true, .rests = rests};
  const bool draw = rests && !busy && frames < wanted;
  return {.draw = draw, .rests = rests, .anew = draw && !std::exchange(begun_, begun_ || draw)};
}

void Pace::drew(int divisor, double milliseconds) {
  // The full picture tells what a smaller one would take, roughly.
  const double expected = divisor == divisor_ ? milliseconds : milliseconds * divisor * divisor / divisor_ / divisor_;
  if (expected > slow_ms) divisor_ = std::min(divisor_ * 2, 8);
  if (expected < fast_ms) divisor_ = std::max(divisor_ / 2, 1);
}

}  // namespace penumbra::viewer

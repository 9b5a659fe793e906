#include "viewer/frame_pacing.h"

#include <algorithm>
#include <utility>

namespace penumbra::viewer {

FramePacing::Step FramePacing::next(double now, bool changed, bool ui_active, int frames, int wanted) {
  if (changed) {
    last_change_ = now;
    restarted_ = false;
    return {.draw = true, .divisor = software_ ? divisor_ : 1};
  }
  const bool idle = now - last_change_ >= idle_seconds;
  if (!software_) return {.draw = true, .idle = idle};
  const bool draw = idle && !ui_active && frames < wanted;
  return {.draw = draw, .idle = idle, .restart = draw && !std::exchange(restarted_, restarted_ || draw)};
}

void FramePacing::drew(int divisor, double milliseconds) {
  // Cost is about proportional to the number of pixels, so a frame of another size predicts this one's.
  const double expected = divisor == divisor_ ? milliseconds : milliseconds * divisor * divisor / divisor_ / divisor_;
  if (expected > slow_ms) divisor_ = std::min(divisor_ * 2, 8);
  if (expected < fast_ms) divisor_ = std::max(divisor_ / 2, 1);
}

}  // namespace penumbra::viewer

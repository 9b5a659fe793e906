#include "viewer/frame_pacing.h"

#include <algorithm>
#include <array>
#include <utility>

namespace penumbra::viewer {

namespace {

// Each costs at least a quarter of the one before, so that one of them suits.
constexpr std::array<Detail, FramePacing::level_count> levels{{{},
                                                               {.maps = 2},
                                                               {.maps = 4},
                                                               {.maps = 4, .reads = 4},
                                                               {.picture = 2, .maps = 4, .reads = 4},
                                                               {.picture = 4, .maps = 4, .reads = 4},
                                                               {.picture = 8, .maps = 4, .reads = 4}}};

}  // namespace

FramePacing::Step FramePacing::next(double now, bool changed, bool ui_active, int frames, int wanted, bool travels) {
  travelling_ = changed && travels && software_;
  if (changed && !travels) forget_travel();
  if (changed) {
    last_change_ = now;
    restarted_ = false;
    Detail detail;
    if (software_) detail = travels ? levels.at(level_) : Detail{.picture = divisor_};
    return {.draw = true, .detail = detail};
  }
  const bool idle = now - last_change_ >= idle_seconds;
  if (!software_) return {.draw = true, .idle = idle};
  const bool draw = idle && !ui_active && frames < wanted;
  return {.draw = draw, .idle = idle, .restart = draw && !std::exchange(restarted_, restarted_ || draw)};
}

void FramePacing::go_to(std::size_t level) {
  level_ = level;
  drawn_at_level_ = slow_in_turn_ = 0;
}

void FramePacing::forget_travel() {
  most_ = levels.size() - 1;
  best_.fill(0);
}

// Where a smaller picture takes almost as long, such as where casters cost most, the larger one is kept.
bool FramePacing::is_level_useless() const {
  const double before = level_ > whole_picture ? best_.at(level_ - 1) : 0;
  return drawn_at_level_ >= tried && before > 0 && best_.at(level_) > worth * before;
}

// Whether the level before this one was left for what may have been chance.
bool FramePacing::suits_again(std::size_t level, double beside) const {
  const double before = level > 0 ? best_.at(level - 1) : 0;
  return before > 0 && before + beside <= with_room * slow_ms;
}

void FramePacing::drew_travelling(double milliseconds, double beside) {
  double& best = best_.at(level_);
  const bool other_view = level_ == most_ && best > 0 && milliseconds > 3 * best;
  best = best > 0 ? std::min(best, milliseconds) : milliseconds;
  ++drawn_at_level_;
  if (milliseconds < fast_ms && level_ > 0) return go_to(level_ - 1);
  const bool slow = milliseconds + beside > slow_ms;
  slow_in_turn_ = slow ? slow_in_turn_ + 1 : 0;
  if (drawn_at_level_ >= settled && suits_again(level_, beside)) return go_to(level_ - 1);
  if (!slow) return;
  if (is_level_useless()) {
    most_ = level_ - 1;
    go_to(most_);
  } else if (other_view) {
    forget_travel();
    go_to(whole_picture);
  } else if (level_ < whole_picture) {
    go_to(milliseconds > 4 * slow_ms ? whole_picture : level_ + 1);
  } else if (level_ < most_ && drawn_at_level_ >= tried && slow_in_turn_ >= tried) {
    go_to(level_ + 1);
  }
}

void FramePacing::drew(const Detail& detail, double milliseconds, double beside) {
  if (travelling_) return drew_travelling(milliseconds, beside);
  const int divisor = detail.picture;
  if (divisor == 1 && milliseconds < fast_ms) go_to(0);
  // Cost is about proportional to the number of pixels, so a frame of another size predicts this one's.
  const double expected = divisor == divisor_ ? milliseconds : milliseconds * divisor * divisor / divisor_ / divisor_;
  if (expected + beside > slow_ms) divisor_ = std::min(divisor_ * 2, 8);
  if (expected < fast_ms) divisor_ = std::max(divisor_ / 2, 1);
}

}  // namespace penumbra::viewer

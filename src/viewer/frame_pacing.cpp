#include "viewer/frame_pacing.h"

#include <algorithm>
#include <array>
#include <utility>

namespace penumbra::viewer {

namespace {

// From full detail on.
constexpr std::array<Detail, FramePacing::level_count> levels{{{},
                                                               {.maps = 2},
                                                               {.maps = 4},
                                                               {.maps = 4, .reads = 4},
                                                               {.picture = 2, .maps = 4, .reads = 4},
                                                               {.picture = 3, .maps = 4, .reads = 4},
                                                               {.picture = 4, .maps = 4, .reads = 4},
                                                               {.picture = 6, .maps = 4, .reads = 4},
                                                               {.picture = 8, .maps = 4, .reads = 4}}};

}  // namespace

FramePacing::Step FramePacing::next(double now, bool changed, bool ui_active, int frames, int wanted, bool travels) {
  travelling_ = changed && travels && software_;
  const bool ended = std::exchange(ended_, false);
  if (changed && !travels) forget_travel();
  if (changed) {
    Detail detail;
    if (software_) detail = travels ? levels.at(level_) : Detail{.picture = divisor_};
    last_change_ = ended ? long_ago : now;
    restarted_ = false;
    return {.draw = true, .detail = detail};
  }
  if (ended) last_change_ = long_ago;
  const bool idle = now - last_change_ >= idle_seconds;
  if (!software_) return {.draw = true, .idle = idle};
  const bool draw = idle && !ui_active && frames < wanted;
  return {.draw = draw, .idle = idle, .restart = draw && !std::exchange(restarted_, restarted_ || draw)};
}

void FramePacing::go_to(std::size_t level) {
  left_ms_ = level == level_ + 1 ? std::min(last_ms_, before_last_ms_) : 0;
  level_ = level;
  drawn_at_level_ = slow_in_turn_ = 0;
}

void FramePacing::forget_travel() {
  most_ = levels.size() - 1;
  ratios_.fill(0);
}

// Where a smaller picture takes almost as long, such as where casters cost most, the larger one is kept.
bool FramePacing::is_level_useless() const {
  return level_ > whole_picture && ratios_.at(level_) > 0 && ratios_.at(level_) < 1 / worth;
}

// How many times longer a picture may take at the level before this one; 0: not known. It is at most as many times
// longer as it has more pixels, whatever was measured while other work slowed it down.
double FramePacing::most_ratio_before() const {
  const double measured = ratios_.at(level_);
  if (level_ <= whole_picture) return measured;
  const double sides = static_cast<double>(levels.at(level_).picture) / levels.at(level_ - 1).picture;
  return measured == 0 ? sides * sides : std::min(measured, sides * sides);
}

// Whether the level before this one would be quick enough: as far as is known, since what it costs changes with the
// view, and other work may have slowed it down for a moment.
bool FramePacing::suits_before(double milliseconds, double beside) const {
  if (level_ == 0) return false;
  const double ratio = most_ratio_before();
  if (ratio == 0) return milliseconds < fast_ms;
  return drawn_at_level_ >= settled && milliseconds * ratio + beside <= with_room * slow_ms;
}

void FramePacing::drew_travelling(double milliseconds, double beside) {
  before_last_ms_ = std::exchange(last_ms_, milliseconds);
  ++drawn_at_level_;
  least_ms_ = drawn_at_level_ == 1 ? milliseconds : std::min(least_ms_, milliseconds);
  slow_in_turn_ = milliseconds + beside > slow_ms ? slow_in_turn_ + 1 : 0;
  if (drawn_at_level_ == tried && left_ms_ > 0) ratios_.at(level_) = left_ms_ / std::max(least_ms_, 1e-3);
  if (drawn_at_level_ < tried) return;
  if (suits_before(milliseconds, beside)) return go_to(level_ - 1);
  if (slow_in_turn_ < tried) return;
  if (is_level_useless()) {
    most_ = level_ - 1;
    go_to(most_);
  } else if (level_ >= std::min(most_, whole_picture + 1) &&
             milliseconds > 3 * least_ms_) {  // another view, in which other levels may help
    forget_travel();
    go_to(whole_picture);
  } else if (level_ < whole_picture) {
    go_to(milliseconds > 4 * slow_ms ? whole_picture : level_ + 1);
  } else if (level_ < most_) {
    go_to(level_ + 1);
  }
}

void FramePacing::drew(const Detail& detail, double milliseconds, double beside) {
  if (travelling_) return drew_travelling(milliseconds, beside);
  const int divisor = detail.picture;
  if (divisor == 1 && milliseconds < fast_ms) go_to(0);
  // Cost is about proportional to the number of pixels, so a frame of another size predicts this one's, and the next
  // larger one's.
  const double expected = divisor == divisor_ ? milliseconds : milliseconds * divisor * divisor / divisor_ / divisor_;
  if (expected + beside > slow_ms) {
    divisor_ = std::min(divisor_ * 2, 8);
  } else if (expected < fast_ms && 4 * expected + beside <= slow_ms) {
    divisor_ = std::max(divisor_ / 2, 1);
  }
}

void TurnClock::begin() {
  start_ = std::chrono::steady_clock::now();
  drawn_ = 0;
}

void TurnClock::end() {
  if (drawn_ == 0) return;
  const std::chrono::duration<double, std::milli> all = std::chrono::steady_clock::now() - start_;
  beside_ = all.count() - drawn_;
}

}  // namespace penumbra::viewer

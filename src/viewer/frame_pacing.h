#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include "viewer/detail.h"

namespace penumbra::viewer {

// Decides when to draw, and in what detail, so that the picture follows the mouse without delay also where the CPU
// draws. While camera, lights or time move, what is expensive shrinks before what is seen: the shadow maps, then what a
// pixel reads of them, and last the resolution. While a parameter changes, only the resolution does, so that its effect
// can be seen. A GPU draws every frame at full size and keeps its history when the motion ends, so that no restart is
// visible.
class FramePacing {
 public:
  static constexpr std::size_t level_count = 9;

  explicit FramePacing(bool software) : software_(software) {}

  struct Step {
    bool draw = false;
    Detail detail;
    bool idle = false;     // nothing has changed for a while
    bool restart = false;  // the first full-size frame after motion: drawn without the motion's history
  };
  // What to do at `now`, seconds. `changed`: the last drawing does not show the present document. `frames`: drawn at
  // full size since the last change, of `wanted`. `ui_active`: the user holds a widget, so only changes are drawn.
  // `travels`: camera, lights or time change, and the parameters stay.
  Step next(double now, bool changed, bool ui_active, int frames, int wanted, bool travels = false);

  // The user has ended the motion, as by the release of a button: what next() shows now does not wait for a rest.
  void end_motion() { ended_ = true; }

  bool software() const { return software_; }

  // Reports how long the pictures of the last step took, and how long all else takes until the window shows them: the
  // panels, the copy to the screen. Both choose the detail of the next ones.
  void drew(const Detail& detail, double milliseconds, double beside = 0);

 private:
  static constexpr double idle_seconds = 0.15;  // without a change
  static constexpr double long_ago = -1e9;      // seconds: of a change after which nothing waits for a rest
  // Limits in motion: of an update of the window, and of its pictures alone.
  static constexpr double slow_ms = 100, fast_ms = 20;

  void drew_travelling(double milliseconds, double beside);
  void go_to(std::size_t level);
  void forget_travel();
  bool is_level_useless() const;
  double most_ratio_before() const;
  bool suits_before(double milliseconds, double beside) const;

  static constexpr std::size_t whole_picture = 3;  // the last level at which the picture has its full size
  static constexpr int tried = 2;           // frames at a level before it is judged, and slow ones in turn to leave it
  static constexpr int settled = 20;        // frames at a level before the one before it is tried again
  static constexpr double with_room = 0.9;  // of the limit: what is tried again must be expected to take no more
  static constexpr double worth = 0.75;     // of the time before: a smaller picture has to take no more

  bool software_;
  int divisor_ = 4;  // while a parameter changes
  // Of the details while the view travels, from full on: the present one, and the last that is worth it.
  std::size_t level_ = whole_picture, most_ = level_count - 1;
  // How many times longer a picture took at the level before each, when that was left for it; 0: not known.
  std::array<double, level_count> ratios_{};
  int drawn_at_level_ = 0, slow_in_turn_ = 0;
  // Milliseconds: of the last two pictures in motion, the least at this level, and at the level that was left for it.
  double last_ms_ = 0, before_last_ms_ = 0, least_ms_ = 0, left_ms_ = 0;
  bool travelling_ = false;  // the last step was drawn at that level
  double last_change_ = long_ago;
  bool ended_ = false;      // by end_motion(), since the last step
  bool restarted_ = false;  // since the last change
};

// How long the turns of the viewer's loop take that draw pictures in motion.
class TurnClock {
 public:
  void begin();
  void drew(double milliseconds) { drawn_ = milliseconds; }
  void end();
  // Milliseconds of all else than pictures in the last turn that drew some.
  double beside() const { return beside_; }

 private:
  std::chrono::steady_clock::time_point start_;
  double drawn_ = 0, beside_ = 0;
};

}  // namespace penumbra::viewer

#pragma once

namespace penumbra::viewer {

// Decides when to draw, and at what fraction of the full resolution, so that the picture follows the mouse without
// delay also where the CPU draws. A GPU draws every frame at full size and keeps its history when the motion ends, so
// that no restart is visible.
class FramePacing {
 public:
  explicit FramePacing(bool software) : software_(software) {}

  struct Step {
    bool draw = false;
    int divisor = 1;       // of both sides of the picture
    bool idle = false;     // nothing has changed for a while
    bool restart = false;  // the first full-size frame after motion: drawn without the motion's history
  };
  // What to do at `now`, seconds. `changed`: the last drawing does not show the present document. `frames`: drawn at
  // full size since the last change, of `wanted`. `ui_active`: the user holds a widget, so only changes are drawn.
  Step next(double now, bool changed, bool ui_active, int frames, int wanted);

  bool software() const { return software_; }

  // Reports how long a frame took, which chooses the divisor of the next ones.
  void drew(int divisor, double milliseconds);

 private:
  static constexpr double idle_seconds = 0.25;         // without a change
  static constexpr double slow_ms = 90, fast_ms = 20;  // limits for a frame in motion

  bool software_;
  int divisor_ = 4;
  double last_change_ = -1e9;
  bool restarted_ = false;  // since the last change
};

}  // namespace penumbra::viewer

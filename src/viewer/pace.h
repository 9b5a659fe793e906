#pragma once

namespace penumbra::viewer {

// When to draw, and at what part of the full resolution, so that a hand on the camera is followed at once also where
// the CPU draws. A GPU draws every frame in full, and goes on when motion ends: what a technique remembers is not seen
// to begin once more.
class Pace {
 public:
  explicit Pace(bool software) : software_(software) {}

  struct Step {
    bool draw = false;
    int divisor = 1;     // of both sides of the picture
    bool rests = false;  // for a while
    bool anew = false;   // the first of a picture at rest that takes up nothing of the motion
  };
  // What to do at `now`, seconds. `changed`: what is to be seen is not what was drawn last. `frames`: drawn since, at
  // full size; `wanted`: enough of them. `busy`: a hand is at the panel, so that only what has changed is drawn.
  Step next(double now, bool changed, bool busy, int frames, int wanted);

  bool software() const { return software_; }

  // A frame was drawn.
  void drew(int divisor, double milliseconds);

 private:
  static constexpr double rest_seconds = 0.25;         // after the last change
  static constexpr double slow_ms = 90, fast_ms = 20;  // what a frame in motion may take

  bool software_;
  int divisor_ = 4;
  double last_change_ = -1e9;
  bool begun_ = false;  // the picture at rest
};

}  // namespace penumbra::viewer

#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "gl/timer.h"

namespace penumbra::viewer {

// What passes of the last frames cost, for one of the pictures. Milliseconds.
class Costs {
 public:
  struct Pass {
    std::string name;
    double median = 0;
  };

  // Adds a frame's times by name, "frame" among them, measured at `now`, seconds. Passes within others count there.
  void add(double now, std::map<std::string, double> passes);
  // What passes of the last frame handed to OpenGL, by name; "frame" has all of it.
  void set_work(const std::map<std::string, gl::Timers::Work>& work) { work_ = work; }
  gl::Timers::Work work(const std::string& pass) const;
  // Another scene: medians of the last second say nothing of it.
  void clear();

  // Medians over the last second, at least of the last frame; the dearest first.
  std::vector<Pass> passes() const;
  double frame() const;  // median of the whole
  // The last frames' totals, oldest first.
  const std::vector<float>& history() const { return history_; }

 private:
  struct Frame {
    double at = 0;
    std::map<std::string, double> passes;
  };
  double median_of(const std::string& name) const;

  static constexpr std::size_t most_history = 240;
  std::deque<Frame> frames_;
  std::vector<float> history_;
  std::map<std::string, gl::Timers::Work> work_;
};

// Hands each finished frame of a device's timers to the costs of the picture it was drawn for.
class CostReader {
 public:
  // The frames from now on, until the next call, are for these.
  void start(const gl::Timers& timers, Costs& costs);
  // Takes what is finished, without waiting.
  void read(gl::Timers& timers, double now);

 private:
  std::map<std::size_t, Costs*> from_;  // by the first frame
};

}  // namespace penumbra::viewer

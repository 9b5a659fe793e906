#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "gl/timer.h"

namespace penumbra::viewer {

// The costs of passes over the last frames of one picture, milliseconds.
class Costs {
 public:
  struct Pass {
    std::string name;
    double median = 0;
  };

  // Adds a frame's times by name, "frame" among them, measured at `now`, seconds. A nested pass is part of the one
  // around it.
  void add(double now, std::map<std::string, double> passes);
  // The draws, dispatches and triangles of the last frame's passes, by name; "frame" has all of them.
  void set_work(const std::map<std::string, gl::Timers::Work>& work) { work_ = work; }
  gl::Timers::Work work(const std::string& pass) const;
  // Forgets the last second: another scene, or another size.
  void clear();

  // Medians over the last second, at least of the last frame; the most expensive first.
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
  // Frames drawn from now on, until the next call, count for `costs`.
  void start(const gl::Timers& timers, Costs& costs);
  // Takes the times that have arrived, without waiting for others.
  void read(gl::Timers& timers, double now);

 private:
  std::map<std::size_t, Costs*> from_;  // by the number of their first frame
};

}  // namespace penumbra::viewer

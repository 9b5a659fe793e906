#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/statistics.h"
#include "gl/timer.h"

namespace penumbra::bench {

// Milliseconds of the frames of one contender that count.
struct PassTimes {
  std::vector<gl::Timers::Row> passes;  // one entry a frame, 0 where it was not drawn
  std::vector<double> frames;
  std::vector<double> cpu;  // see gl::Timers::cpu_milliseconds()

  // The last `count` frames of a device's timers: its rows and its times of the CPU.
  void append(const std::vector<gl::Timers::Row>& rows, const std::vector<double>& cpu_times, std::size_t count);
  // Every frame's time of one pass; zeros where there is none of that name.
  std::vector<double> of(std::string_view pass) const;
  // Every frame's sum of the passes that make the shadow mask, and of all passes. A pass within another is a part of it
  // and not counted twice.
  std::vector<double> shadow_sums() const;
  std::vector<double> sums() const;
};

// Whether a pass is there for the shadow mask: all that is not the renderer's own.
bool is_shadow_pass(std::string_view name);

struct PassCost {
  std::string name;
  Summary ms;        // over the frames that drew it
  double share = 0;  // of the frame, medians
  bool shadow = false;
};

// What a technique could not do without, in milliseconds.
struct FloorCost {
  std::optional<Summary> fetch;      // its fetches alone; none for techniques that say nothing of taps
  std::optional<double> mask_ratio;  // its mask pass over that, paired
  Summary copy;                      // one read and one write of the mask
};

// What one contender cost.
struct Cost {
  std::string label;  // "thesis_8x8"
  std::vector<PassCost> passes;
  Summary frame;
  Summary cpu;           // that the drawing thread spent on the frame: a part of it, or beside it where a GPU draws
  Summary passes_sum;    // of the sums of each frame
  double sum_ratio = 0;  // of that sum to the frame, paired
  Summary shadow;        // of the sums of the shadow passes
  Summary swept;         // of what a sweep is about: all shadow passes, or one
  double of_first = 1;   // its shadow passes over the first contender's, paired
  std::size_t target_bytes = 0;
  std::optional<FloorCost> floor;

  // Whether the passes make up the frame within a tenth.
  bool adds_up() const { return sum_ratio > 0.9 && sum_ratio < 1.1; }
};

// The cost of `times` beside those of the first contender; label, memory, floor and `swept` are the caller's.
Cost cost_of(const PassTimes& times, const PassTimes& first);

}  // namespace penumbra::bench

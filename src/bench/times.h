#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/statistics.h"
#include "gl/timer.h"

namespace penumbra::bench {

// Times in milliseconds of the measured frames of one contender.
struct PassTimes {
  std::vector<gl::Timers::Row> passes;  // one value per frame, 0 if the pass was not drawn in it
  std::vector<double> frames;
  std::vector<double> cpu;  // see gl::Timers::cpu_milliseconds()

  // Appends the last `count` frames of a device's timers: the rows of passes and the CPU times.
  void append(const std::vector<gl::Timers::Row>& rows, const std::vector<double>& cpu_times, std::size_t count);
  // Of single frames of a device's timers, by their indices; without CPU times.
  static PassTimes of_frames(const std::vector<gl::Timers::Row>& rows, std::span<const std::size_t> indices);
  // The time of one pass in every frame; zeros if there is no pass of that name.
  std::vector<double> of(std::string_view pass) const;
  // For every frame, the sum of the passes that draw the shadow mask, and the sum of all passes. A nested pass is part
  // of the one around it and not counted twice.
  std::vector<double> shadow_sums() const;
  std::vector<double> sums() const;
};

// Whether a pass serves the shadow mask: every pass that is not one of the renderer's.
bool is_shadow_pass(std::string_view name);

struct PassCost {
  std::string name;
  Summary ms;        // over the frames that drew it
  double share = 0;  // of the time of all measured frames
  bool shadow = false;
};

// The lower bound of a technique's cost, in milliseconds: see Floor.
struct FloorCost {
  std::optional<Summary> fetch;      // its fetches alone; absent if it is not known how many these are
  std::optional<double> mask_ratio;  // paired ratio of its mask pass to `fetch`
  Summary copy;                      // one read and one write of the mask with details
};

// What one contender cost.
struct Cost {
  std::string label;  // "thesis_8x8"
  std::vector<PassCost> passes;
  Summary frame;
  Summary cpu;           // of the drawing thread; on a GPU it overlaps the frame's time, else it is part of it
  Summary passes_sum;    // sum of all passes in each frame
  double sum_ratio = 0;  // paired ratio of that sum to the frame
  Summary shadow;        // sum of the shadow passes in each frame
  Summary swept;         // what a sweep plots and fits: all shadow passes, or one pass
  double of_first = 1;   // paired ratio of its shadow passes, or of its frames if no pass was timed, to the first's
  std::size_t shadow_bytes = 0;
  std::optional<FloorCost> floor;

  // Else only its frames are known: the members about passes are empty.
  bool has_passes() const { return !passes.empty(); }
  // The time of a pass in a frame that stands for all: its median, as often as frames drew it.
  double per_frame(const PassCost& pass) const;
  // Whether the sum of the passes is within 10 % of the frame's time.
  bool adds_up() const { return sum_ratio > 0.9 && sum_ratio < 1.1; }
};

// The cost from `times`, and its ratio to the first contender's. The caller fills in label, memory, floor and `swept`.
Cost cost_of(const PassTimes& times, const PassTimes& first);

}  // namespace penumbra::bench

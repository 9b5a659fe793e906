#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/contender.h"
#include "bench/linear_fit.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/sweep.h"
#include "bench/times.h"
#include "gl/context.h"

namespace penumbra::bench {

// All contenders at one point of the sweep.
struct Measured {
  Point point;
  cli::Size size;
  long long triangles = 0;  // that the scene draws
  std::vector<Cost> costs;  // in the order of Results::entries
};

// How the cost of one entry depends on the axes of a sweep.
struct Model {
  std::string label;
  LinearFit fit;  // milliseconds as a function of the axes
};

// All results of a run, and how they were measured.
struct Results {
  std::string version, commit, command;
  Machine machine;
  std::optional<int> threads;  // that --threads allows; absent: one for each core
  gl::DeviceInfo device;
  std::string backend;
  std::string timing;  // "GPU timestamps"
  std::string scene;   // its file's name
  bool sun = false;    // shines on it
  FrameCounts frames;
  std::vector<Entry> entries;
  Sweep sweep;
  std::vector<Measured> points;  // one if there is no sweep
  std::vector<Model> models;     // empty without a sweep, or with too few points
};

// "ms = 0.12 + 0.034 · blocker_taps + 0.05 · filter_taps"
std::string equation_of(const Model& model, const Sweep& sweep);
// ", in 3 of 20 frames", or empty if all frames drew the pass
std::string drawn_in(const PassCost& pass, const Cost& cost);
// Whether lower bounds were measured. Masks then have details (see shadow::Mask), which costs all techniques some time.
bool has_floor(const Measured& point);
// "shadow passes" or the one pass that the sweep is about
std::string subject_of(const Sweep& sweep);
// "drawn anew in every frame": whether shadow maps were, with these parameters or with all of these; at least one.
std::string maps_of(const ParamSet& params);
std::string maps_of(std::span<const ParamSet* const> of_all);
std::string maps_of(const Results& results);
// "courtyard.glb, 1280×720, 4 cascades of 2048×2048, maps drawn anew in every frame"; without a sun no cascades. With
// lower bounds also what they make different.
std::string setting_of(const Results& results);

std::string json_of(const Results& results);
// One row for each pass of a contender at a point, with columns that identify the run, so that files of several runs
// can be joined. The sum of all passes, the shadow passes, the frame and its CPU time are rows too.
std::string csv_of(const Results& results);
std::string html_of(const Results& results);
// For the terminal.
std::string text_of(const Results& results);

}  // namespace penumbra::bench

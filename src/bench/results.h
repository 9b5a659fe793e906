#pragma once

#include <optional>
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

// What a sweep found of one entry.
struct Model {
  std::string label;
  LinearFit fit;  // of milliseconds, by the axes
};

// All that a run found, with all that one must know of how.
struct Results {
  std::string version, commit, command;
  Machine machine;
  gl::DeviceInfo device;
  std::string backend;
  std::string timing;  // "GPU timestamps"
  std::string scene;   // its file's name
  FrameCounts frames;
  std::vector<Entry> entries;
  Sweep sweep;
  std::vector<Measured> points;  // one if there is no sweep
  std::vector<Model> models;     // empty without a sweep, or with too few points
};

// "ms = 0.12 + 0.034 · blocker_taps + 0.05 · filter_taps"
std::string equation_of(const Model& model, const Sweep& sweep);
// "shadow passes" or the one pass that the sweep is about
std::string subject_of(const Sweep& sweep);
// "courtyard.glb, 1280×720, 4 cascades of 2048×2048"
std::string setting_of(const Results& results);

std::string json_of(const Results& results);
// One row a pass of a contender at a point, with all that tells rows of many runs apart; the sum of passes, the shadow
// passes, the frame and its CPU time are rows too.
std::string csv_of(const Results& results);
std::string html_of(const Results& results);
// For the terminal.
std::string text_of(const Results& results);

}  // namespace penumbra::bench

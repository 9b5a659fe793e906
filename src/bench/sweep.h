#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/usage.h"
#include "core/params.h"

namespace penumbra::bench {

// What one measurement of a sweep differs in from the others.
struct Point {
  std::vector<double> at;          // along each axis, in its unit
  std::vector<std::string> names;  // the same as one says it: "1280x720"
  // Values of parameters; a name that begins with '.' is the technique's own.
  std::vector<std::pair<std::string, ParamValue>> values;
  std::optional<cli::Size> size;
  std::optional<long long> triangles;  // of the casters
};

// Cost grows about linearly with what an axis counts.
struct Axis {
  std::string name;  // "blocker_taps"
  std::string unit;  // "taps"
  bool log = false;  // how its values are best shown
};

struct Sweep {
  std::string name;  // empty: one point that differs in nothing
  std::string pass;  // the one that it is about; empty: all that are there for shadows
  std::vector<Axis> axes;
  std::vector<Point> points;
};

const std::vector<std::string>& sweep_names();

// What a sweep is held to.
struct SweepLimits {
  bool software = false;  // ends where patience does
  cli::Size size;         // that the command line asks for
  int max_texture = 16384;
  int cascades = 4;             // the most of any entry
  long long own_triangles = 0;  // of the scene that casters are copies of; 0: there is none
};

// `name` is empty or one of sweep_names().
Sweep make_sweep(const std::string& name, const SweepLimits& limits);

// The values of an entry at a point. Throws UsageError where its technique does not have what is swept.
ParamSet params_at(const Point& point, const ParamSet& params);

}  // namespace penumbra::bench

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/usage.h"
#include "core/params.h"

namespace penumbra::bench {

// One measurement of a sweep: the settings in which it differs from the others.
struct Point {
  std::vector<double> at;          // along each axis, in its unit
  std::vector<std::string> names;  // the same as text: "1280x720"
  // Values of parameters. A name that begins with '.' is a parameter of the technique (".blocker_taps").
  std::vector<std::pair<std::string, ParamValue>> values;
  std::optional<cli::Size> size;
  std::optional<long long> triangles;  // of the casters
  std::optional<int> lights;           // of the scene's, the first ones
};

// A quantity that a sweep varies. Cost is expected to grow about linearly with it.
struct Axis {
  std::string name;  // "blocker_taps"; a column of CSV files and a key of JSON, so unlike those of every point
  std::string unit;  // "taps"
  bool log = false;  // plot it on a logarithmic scale
  // What Point::names say, where that is another quantity ("size" beside pixels).
  std::string of_names = {};
};

struct Sweep {
  std::string name;  // empty: no sweep, a single point
  std::string pass;  // the pass that is plotted and fitted; empty: all shadow passes
  std::vector<Axis> axes;
  std::vector<Point> points;
};

const std::vector<std::string>& sweep_names();

// What limits the points of a sweep.
struct SweepLimits {
  bool software = false;  // a software rasteriser: leave out points that would take too long
  cli::Size size;         // that the command line asks for
  int max_texture = 16384;
  int cascades = 4;             // the largest count of any entry
  int lights = 8;               // of the scene that cast shadows
  bool sun = true;              // whether one of them is a sun
  long long own_triangles = 0;  // triangles of the scene that casters are copies of; 0: no such scene
};

// Whether a sweep varies what only shadows of suns depend on.
bool is_of_suns(const std::string& sweep);

// `name` is empty or one of sweep_names().
Sweep make_sweep(const std::string& name, const SweepLimits& limits);

// The parameters that a sweep sets, by their full names.
std::vector<std::string> swept_params(const std::string& sweep, const ParamSet& params);

// The values of an entry at a point. Throws UsageError if its technique lacks the swept parameter.
ParamSet params_at(const Point& point, const ParamSet& params);

}  // namespace penumbra::bench

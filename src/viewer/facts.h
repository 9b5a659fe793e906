#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gl/context.h"
#include "metrics/error_figures.h"
#include "shadow/registry.h"
#include "viewer/costs.h"
#include "viewer/inspect.h"
#include "viewer/painter.h"

namespace penumbra::viewer {

// One value under the cursor.
struct ProbeRow {
  std::string name, value;
};

// How far A is from B, over the surfaces of the picture.
struct Distance {
  metrics::ErrorFigures figures;  // of visibility
  double flip = 0;
};

// What the panels show and can't change.
struct Facts {
  const shadow::Registry& techniques;
  const gl::DeviceInfo& device;
  const gl::Device& gl;
  const LoadedScene* scene = nullptr;  // absent until one is loaded
  std::string loading;                 // the file that is being read, or empty
  const Costs& costs_a;
  const Costs& costs_b;
  glm::ivec2 drawn_size{0};  // of the last picture, pixels
  int frames = 0;            // drawn since something changed
  bool at_rest = false;      // what is seen is what it will stay
  std::vector<std::string> shader_errors;
  std::optional<double> writing;     // share of the files that are written
  std::string command;               // what draws this picture in a shell
  std::optional<double> tracing;     // share of the truth that is traced
  bool both_traced = false;          // A and B: B is not drawn
  bool b_waits = false;              // what is seen of B is older than A
  std::optional<Distance> distance;  // A to B, both at rest
  std::optional<glm::ivec2> probed;  // the picture's pixel under the cursor
  std::vector<ProbeRow> probe;
  Look look;     // of what is inspected
  Range range;   // of the colours
  Range values;  // of A's values; the same but for differences
};

}  // namespace penumbra::viewer

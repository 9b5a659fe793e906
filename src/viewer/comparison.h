#pragma once

#include "core/params.h"

namespace penumbra::viewer {

// How picture A and picture B share the window.
enum class Comparing { a, b, wipe, side_by_side, difference };

struct Comparison {
  bool on = false;
  Comparing how = Comparing::wipe;
  ParamSet params;    // of B
  float wipe = 0.5f;  // where B begins, 0..1 of the window's width
  float gain = 8.0f;  // of the difference
};

// What is seen of the picture: its point in the middle of the window, 0..1 from the upper left, and how many window
// pixels one of its pixels takes.
struct Zoom {
  float factor = 1;
  glm::vec2 center{0.5f};
};

}  // namespace penumbra::viewer

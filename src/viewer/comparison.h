#pragma once

#include <glm/glm.hpp>

#include "core/params.h"

namespace penumbra::viewer {

// How picture A and picture B share the window.
enum class CompareMode { a, b, wipe, side_by_side, difference };

struct Comparison {
  bool on = false;
  CompareMode how = CompareMode::wipe;
  ParamSet params;    // of B
  float wipe = 0.5f;  // where B begins, 0..1 of the window's width
  float gain = 8.0f;  // of the difference

  bool operator==(const Comparison&) const = default;
};

// The part of the picture that the window shows: the point in its middle, 0..1 from the picture's upper left, and how
// many window pixels one of the picture's pixels takes.
struct Zoom {
  float factor = 1;
  glm::vec2 center{0.5f};

  bool operator==(const Zoom&) const = default;
};

}  // namespace penumbra::viewer

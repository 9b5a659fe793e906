#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <vector>

#include "report/html.h"

namespace penumbra::reproduce {

// Points of the unit square, y upwards; the first `highlighted` of them stand out.
struct PointSet {
  std::span<const glm::vec2> points;
  std::size_t highlighted = 0;
};

// Drawn as vectors, with `alt` as its alternative text. `second` is drawn as rings over the first.
report::Html point_plot(const std::string& alt, const PointSet& set, std::span<const glm::vec2> second = {});

}  // namespace penumbra::reproduce

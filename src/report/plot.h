#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "report/axis.h"
#include "report/html.h"

namespace penumbra::report {

struct Point {
  double x = 0, y = 0;
};

// The points that no other betters, where less is better in both: indices by rising x (and falling y). Of points at the
// same place each is one; what is not finite is none.
std::vector<std::size_t> pareto_front(std::span<const Point> points);

// One dot of a scatter plot.
struct Dot {
  std::string label;    // beside it, where there is room
  std::string tooltip;  // more than the label and its values; may be empty
  Point at;
};

// Dots with their labels, and the Pareto front (less is better in both) as a stair. What an axis can't show is named
// under the plot.
struct ScatterPlot {
  std::string title;  // what it shows, also for those who can't see it
  Axis x, y;
  std::vector<Dot> dots;
};
Html to_html(const ScatterPlot& plot);

struct Line {
  std::string label;
  std::vector<Point> points;  // by rising x; a point that an axis can't show parts the line
  bool guide = false;         // dashed and grey, without dots: a slope or a limit to compare with
};

// Lines with their names at their ends.
struct LinePlot {
  std::string title;
  Axis x, y;
  std::vector<Line> lines;
};
Html to_html(const LinePlot& plot);

}  // namespace penumbra::report

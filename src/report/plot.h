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

// The Pareto front: the points that no other point improves on, where less is better in both coordinates, as indices in
// order of rising x (and falling y). Equal points are all included; points that are not finite are excluded.
std::vector<std::size_t> pareto_front(std::span<const Point> points);

// One dot of a scatter plot.
struct Dot {
  std::string label;    // drawn beside the dot, where there is room
  std::string tooltip;  // added to the label and the values; may be empty
  Point at;
};

// Dots with their labels, and the Pareto front (less is better in both) as a step line. Dots that an axis can't show
// are listed below the plot.
struct ScatterPlot {
  std::string title;  // what it shows; also the text alternative of the plot
  Axis x, y;
  std::vector<Dot> dots;
};
Html to_html(const ScatterPlot& plot);

struct Line {
  std::string label;
  std::vector<Point> points;  // in order of rising x; a point that an axis can't show interrupts the line
};

// Lines with their names at their ends.
struct LinePlot {
  std::string title;
  Axis x, y;
  std::vector<Line> lines;
};
Html to_html(const LinePlot& plot);

// One bar of a bar plot: its parts lie end to end, in the order of BarPlot::parts.
struct Bar {
  std::string label;
  std::vector<double> values;  // of each part, 0 or more
};

// Horizontal bars of parts, which a list of colours names. Each part's value is its tooltip; the sum stands at the
// bar's end. Of more parts than there are colours, the least are drawn as one, "others".
struct BarPlot {
  std::string title;
  Axis x;                          // not logarithmic
  std::vector<std::string> parts;  // their names
  std::vector<Bar> bars;
};
Html to_html(const BarPlot& plot);

}  // namespace penumbra::report

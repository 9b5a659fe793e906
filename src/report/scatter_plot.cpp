#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "report/number.h"
#include "report/plot.h"
#include "report/plot_frame.h"

namespace penumbra::report {

namespace {

constexpr double radius = 5.5;
constexpr double room_right = 24;

struct Spot {
  double x, y;
};

Box around(const Spot& spot, double half_side) {
  return {spot.x - half_side, spot.y - half_side, spot.x + half_side, spot.y + half_side};
}

// Positions for a label of that width around a dot, best first.
std::vector<Box> places(const Spot& spot, double width) {
  constexpr double gap = radius + 5, ascent = 0.8 * font_size, height = 1.15 * font_size;
  const double middle = spot.y - height / 2;
  std::vector<Box> boxes;
  const auto add = [&](double left, double top) { boxes.push_back({left, top, left + width, top + height}); };
  add(spot.x + gap, middle);
  add(spot.x - gap - width, middle);
  add(spot.x - width / 2, spot.y - gap - ascent);
  add(spot.x - width / 2, spot.y + gap - 2);
  for (const double side : {1.0, -1.0}) {
    const double left = side > 0 ? spot.x + radius : spot.x - radius - width;
    add(left, spot.y - gap - ascent);
    add(left, spot.y + gap - 2);
  }
  return boxes;
}

// The step line of the front as thin boxes.
std::vector<Box> boxes_of_front(const std::vector<Spot>& front, const Box& area) {
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < front.size(); ++i) {
    const bool first = i == 0, last = i + 1 == front.size();
    boxes.push_back({front[i].x - 1, first ? area.top : front[i - 1].y, front[i].x + 1, front[i].y});
    boxes.push_back({front[i].x, front[i].y - 1, last ? area.right : front[i + 1].x, front[i].y + 1});
  }
  return boxes;
}

bool overlaps_any(const Box& box, const std::vector<Box>& others) {
  return std::ranges::any_of(others, [&](const Box& other) { return box.overlaps(other); });
}

// For each dot a position for its label that overlaps neither dots nor other labels, and the front only if unavoidable;
// nothing where there is no room.
std::vector<std::optional<Box>> place_labels(const std::vector<Spot>& spots, const std::vector<std::string>& labels,
                                             const std::vector<Box>& front, const Box& area) {
  std::vector<Box> taken;
  for (const Spot& spot : spots) taken.push_back(around(spot, radius + 1));
  std::vector<std::optional<Box>> placed(spots.size());
  for (std::size_t i = 0; i < spots.size(); ++i) {
    for (const Box& box : places(spots[i], text_width(labels[i]))) {
      if (!area.holds(box) || overlaps_any(box, taken)) continue;
      const bool clear = !overlaps_any(box, front);
      if (clear || !placed[i]) placed[i] = box;
      if (clear) break;
    }
    if (placed[i]) taken.push_back(*placed[i]);
  }
  return placed;
}

std::string value_text(const Axis& axis, double value) {
  return significant(value, 4) + (axis.unit.empty() ? "" : " " + axis.unit);
}

std::string tooltip_of(const ScatterPlot& plot, const Dot& dot) {
  const std::string values =
      fmt::format("{}: {}, {}", dot.label, value_text(plot.x, dot.at.x), value_text(plot.y, dot.at.y));
  return escape(dot.tooltip.empty() ? values : values + "\n" + dot.tooltip);
}

// From each point of the front to the right up to the next point's cost, then down to its error: the least error that
// is possible at each cost.
std::string front_path(const std::vector<Spot>& front, const Box& area) {
  if (front.empty()) return "";
  std::string path = fmt::format("M{:.1f} {:.1f}V{:.1f}", front[0].x, area.top, front[0].y);
  for (std::size_t i = 1; i < front.size(); ++i) path += fmt::format("H{:.1f}V{:.1f}", front[i].x, front[i].y);
  return fmt::format("<path class='front' d='{}H{:.1f}'/>", path, area.right);
}

std::string dot_svg(const Spot& spot, bool on_front, const std::string& tooltip) {
  return fmt::format("<circle class='dot{}' cx='{:.1f}' cy='{:.1f}' r='{}'><title>{}</title></circle>",
                     on_front ? " on-front" : "", spot.x, spot.y, radius, tooltip);
}

std::string label_svg(const Box& box, const std::string& label) {
  return fmt::format("<text class='label' x='{:.1f}' y='{:.1f}'>{}</text>", box.left, box.bottom - 3.5, escape(label));
}

std::string missing_note(const ScatterPlot& plot, const std::vector<Dot>& missing) {
  if (missing.empty()) return "";
  std::string text = "<p class='note'>Off the plot: ";
  for (const Dot& dot : missing)
    text += fmt::format("{}{} ({}, {})", &dot == &missing.front() ? "" : "; ", escape(dot.label),
                        value_text(plot.x, dot.at.x), value_text(plot.y, dot.at.y));
  return text + ".</p>\n";
}

}  // namespace

std::vector<std::size_t> pareto_front(std::span<const Point> points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::erase_if(order, [&](std::size_t i) { return !std::isfinite(points[i].x) || !std::isfinite(points[i].y); });
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return points[a].x != points[b].x ? points[a].x < points[b].x : points[a].y < points[b].y;
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order) {
    const bool better = front.empty() || points[i].y < points[front.back()].y;
    const bool same = !front.empty() && points[i].y == points[front.back()].y && points[i].x == points[front.back()].x;
    if (better || same) front.push_back(i);
  }
  return front;
}

Html to_html(const ScatterPlot& plot) {
  std::vector<double> xs, ys;
  for (const Dot& dot : plot.dots) {
    xs.push_back(dot.at.x);
    ys.push_back(dot.at.y);
  }
  const PlotFrame frame(plot.title, plot.x, plot.y, xs, ys, room_right);

  std::vector<Dot> shown, missing;
  for (const Dot& dot : plot.dots)
    (frame.x().shows(dot.at.x) && frame.y().shows(dot.at.y) ? shown : missing).push_back(dot);
  std::vector<Point> points;
  std::vector<Spot> spots, front_spots;
  std::vector<std::string> labels;
  for (const Dot& dot : shown) {
    points.push_back(dot.at);
    spots.push_back({frame.x().at(dot.at.x), frame.y().at(dot.at.y)});
    labels.push_back(dot.label);
  }
  const std::vector<std::size_t> front = pareto_front(points);
  for (const std::size_t i : front) front_spots.push_back(spots[i]);

  std::string drawn = front_path(front_spots, frame.area());
  for (std::size_t i = 0; i < shown.size(); ++i)
    drawn += dot_svg(spots[i], std::ranges::find(front, i) != front.end(), tooltip_of(plot, shown[i]));
  const std::vector<std::optional<Box>> placed =
      place_labels(spots, labels, boxes_of_front(front_spots, frame.area()), frame.area());
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (placed[i]) drawn += label_svg(*placed[i], labels[i]);
  }
  return Html(frame.svg(drawn) + missing_note(plot, missing));
}

}  // namespace penumbra::report

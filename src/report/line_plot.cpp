#include <fmt/format.h>

#include <algorithm>

#include "report/number.h"
#include "report/plot.h"
#include "report/plot_frame.h"

namespace penumbra::report {

namespace {

constexpr double dot_radius = 3.2;
constexpr double name_gap = 10, sample_length = 24;
constexpr double name_step = 1.25 * font_size, most_name = 260;
constexpr std::size_t colours = 8;  // .line-0 to .line-7 in page.css
constexpr std::size_t dashes = 5;   // .dash-1 to .dash-4, and lines without

// The label of a line, at the height of the line's end.
struct Name {
  std::size_t line;
  double y;
};

// Moves overlapping labels apart by as little as possible, and keeps them within the plot.
void part(std::vector<Name>& names, const Box& area) {
  std::ranges::stable_sort(names, {}, &Name::y);
  for (std::size_t i = 1; i < names.size(); ++i) names[i].y = std::max(names[i].y, names[i - 1].y + name_step);
  double limit = area.bottom;
  for (std::size_t i = names.size(); i-- > 0; limit -= name_step) names[i].y = std::min(names[i].y, limit);
}

// Lines beyond the number of colours are dashed.
std::string line_class(std::size_t index) {
  return fmt::format("line-{} dash-{}", index % colours, index / colours % dashes);
}

// A piece of the line, and its name.
std::string name_svg(const LinePlot& plot, const Name& name, double x) {
  const double text = x + sample_length + name_gap;
  return fmt::format(
      "<g class='{0}'><path d='M{1:.1f} {2:.1f}H{3:.1f}'/></g>"
      "<text class='label name {0}' x='{4:.1f}' y='{5:.1f}'>{6}</text>",
      line_class(name.line), x, name.y, x + sample_length, text, name.y + 4.5,
      label_text(plot.lines[name.line].label, most_name));
}

std::string dot_svg(const LinePlot& plot, const Line& line, const Point& point, double x, double y) {
  const auto value = [](const Axis& axis, double v) {
    return significant(v, 4) + (axis.unit.empty() ? "" : " " + axis.unit);
  };
  const std::string tooltip = fmt::format("{}: {}, {}", line.label, value(plot.x, point.x), value(plot.y, point.y));
  return fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{}'><title>{}</title></circle>", x, y, dot_radius,
                     escape(tooltip));
}

// SVG of a line's path and dots; `end` is set to the height of its last point.
std::string line_svg(const LinePlot& plot, const PlotFrame& frame, std::size_t index, double& end) {
  const Line& line = plot.lines[index];
  std::string path, dots;
  bool drawing = false;
  for (const Point& point : line.points) {
    if (!frame.x().shows(point.x) || !frame.y().shows(point.y)) {
      drawing = false;
      continue;
    }
    const double x = frame.x().at(point.x), y = frame.y().at(point.y);
    path += fmt::format("{}{:.1f} {:.1f}", drawing ? 'L' : 'M', x, y);
    dots += dot_svg(plot, line, point, x, y);
    drawing = true;
    end = y;
  }
  if (path.empty()) return "";
  return fmt::format("<g class='{}'><path d='{}'/>{}</g>", line_class(index), path, dots);
}

}  // namespace

Html to_html(const LinePlot& plot) {
  std::vector<double> xs, ys;
  double widest = 0;
  for (const Line& line : plot.lines) {
    widest = std::max(widest, text_width(line.label));
    for (const Point& point : line.points) {
      xs.push_back(point.x);
      ys.push_back(point.y);
    }
  }
  const PlotFrame frame(plot.title, plot.x, plot.y, xs, ys, std::min(widest, most_name) + sample_length + 3 * name_gap,
                        name_step * static_cast<double>(plot.lines.size()));

  std::string drawn;
  std::vector<Name> names;
  for (std::size_t i = 0; i < plot.lines.size(); ++i) {
    Name name{i, 0};
    const std::string svg = line_svg(plot, frame, i, name.y);
    if (svg.empty()) continue;
    drawn += svg;
    names.push_back(name);
  }
  part(names, frame.area());
  for (const Name& name : names) drawn += name_svg(plot, name, frame.area().right + name_gap);
  return Html(frame.svg(drawn));
}

}  // namespace penumbra::report

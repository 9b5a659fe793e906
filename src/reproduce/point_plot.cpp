#include "reproduce/point_plot.h"

#include <fmt/format.h>

namespace penumbra::reproduce {

namespace {

constexpr double side = 360, margin = 10;

std::string circle(const glm::vec2& at, const char* style, double radius) {
  return fmt::format("<circle cx='{:.2f}' cy='{:.2f}' r='{}' style='{}'/>", margin + static_cast<double>(at.x) * side,
                     margin + (1 - static_cast<double>(at.y)) * side, radius, style);
}

}  // namespace

report::Html point_plot(const std::string& alt, const PointSet& set, std::span<const glm::vec2> second) {
  constexpr const char* plain = "fill:var(--ink)";
  constexpr const char* quiet = "fill:var(--dot)";
  constexpr const char* strong = "fill:var(--line-0)";
  constexpr const char* ring = "fill:none;stroke:var(--line-1);stroke-width:1.6";
  const bool singles_out = set.highlighted > 0;
  std::string svg = fmt::format(
      "<svg viewBox='0 0 {0} {0}' role='img' aria-label='{1}' style='display:block;width:100%;margin-top:8px'>"
      "<rect x='{2}' y='{2}' width='{3}' height='{3}' style='fill:none;stroke:var(--line)'/>",
      side + 2 * margin, report::escape(alt), margin, side);
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    const bool first = i < set.highlighted;
    svg += circle(set.points[i], first ? strong : singles_out ? quiet : plain, first ? 5.5 : 2.6);
  }
  for (const glm::vec2& point : second) svg += circle(point, ring, 4.2);
  return report::Html(svg + "</svg>\n");
}

}  // namespace penumbra::reproduce

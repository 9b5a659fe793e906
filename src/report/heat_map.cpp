#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "report/number.h"
#include "report/table.h"

namespace penumbra::report {

namespace {

using Rgb = std::array<double, 3>;

// From light for low to dark for high values, in even steps of lightness, so that it also reads in grey.
constexpr std::array<Rgb, 5> ramp{{{255, 247, 224}, {253, 208, 137}, {240, 138, 84}, {178, 64, 86}, {72, 22, 74}}};

Rgb colour_at(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(ramp.size() - 1);
  const auto index = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
  Rgb colour;
  for (std::size_t i = 0; i < 3; ++i)
    colour[i] = std::lerp(ramp[index][i], ramp[index + 1][i], place - static_cast<double>(index));
  return colour;
}

// WCAG 2.1's relative luminance.
double luminance(const Rgb& colour) {
  const auto linear = [](double v) {
    return v <= 0.04045 * 255 ? v / 255 / 12.92 : std::pow((v / 255 + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(colour[0]) + 0.7152 * linear(colour[1]) + 0.0722 * linear(colour[2]);
}

// The range of the values, and where a value is in it.
struct Range {
  double low, high;

  double share(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

Range range_of(const HeatMap& map) {
  Range range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const double value : map.values) {
    if (!std::isfinite(value)) continue;
    range.low = std::min(range.low, value);
    range.high = std::max(range.high, value);
  }
  return range;
}

std::string cell(const HeatMap& map, const Range& range, double value) {
  if (!std::isfinite(value)) return "<td>–</td>";
  const Rgb colour = colour_at(range.share(value));
  // The luminance at which black and white text have the same contrast.
  const char* ink = luminance(colour) > 0.179 ? "#111" : "#fff";
  return fmt::format("<td style='background:rgb({:.0f} {:.0f} {:.0f});color:{}'>{}</td>", colour[0], colour[1],
                     colour[2], ink, fixed(value, map.decimals));
}

}  // namespace

Html to_html(const HeatMap& map) {
  const std::size_t columns = map.column_names.size(), rows = map.row_names.size();
  assert(map.values.size() == rows * columns);
  const Range range = range_of(map);
  std::string head =
      fmt::format("<tr><td></td><th scope='colgroup' colspan='{}'>{}</th></tr>\n<tr><th scope='col'>{}</th>", columns,
                  escape(map.column_title), escape(map.row_title));
  for (const std::string& name : map.column_names) head += fmt::format("<th scope='col'>{}</th>", escape(name));
  std::string body;
  for (std::size_t row = 0; row < rows; ++row) {
    body += fmt::format("<tr><th scope='row'>{}</th>", escape(map.row_names[row]));
    for (std::size_t column = 0; column < columns; ++column)
      body += cell(map, range, map.values[row * columns + column]);
    body += "</tr>\n";
  }
  const std::string unit = map.unit.empty() ? "" : fmt::format(" <span class='unit'>({})</span>", escape(map.unit));
  return Html(
      fmt::format("<div class='table' tabindex='0'><table class='heat'><caption><span>{}{}</span></caption>\n"
                  "<thead>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
                  escape(map.caption), unit, head, body));
}

}  // namespace penumbra::report

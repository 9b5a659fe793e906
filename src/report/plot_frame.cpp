#include "report/plot_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "report/html.h"

namespace penumbra::report {

namespace {

constexpr double width = 760, least_height = 430;
constexpr double left = 76, top = 18, bottom = 58;
// Labels are monospaced.
constexpr double character_width = 0.58 * font_size;

// Whether that is the first byte of a character of UTF-8.
bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }

std::string axis_title(const Axis& axis) {
  return escape(axis.unit.empty() ? axis.label : axis.label + " (" + axis.unit + ")");
}

std::string grid(const Scale& x, const Scale& y, const Box& area) {
  std::string svg;
  for (const Tick& tick : x.ticks()) {
    svg += fmt::format(
        "<path class='grid' d='M{0:.1f} {1:.1f}V{2:.1f}'/>"
        "<text class='tick' x='{0:.1f}' y='{3:.1f}' text-anchor='middle'>{4}</text>",
        x.at(tick.value), area.top, area.bottom, area.bottom + 20, escape(tick.label));
  }
  for (const Tick& tick : y.ticks()) {
    svg += fmt::format(
        "<path class='grid' d='M{1:.1f} {0:.1f}H{2:.1f}'/>"
        "<text class='tick' x='{3:.1f}' y='{4:.1f}' text-anchor='end'>{5}</text>",
        y.at(tick.value), area.left, area.right, area.left - 9, y.at(tick.value) + 4.5, escape(tick.label));
  }
  return svg;
}

}  // namespace

double text_width(std::string_view text) {
  return character_width * static_cast<double>(std::ranges::count_if(text, begins_character));
}

std::string label_text(std::string_view label, double room) {
  const auto most = static_cast<std::ptrdiff_t>(std::max(room / character_width + 1e-6, 3.0));
  const std::ptrdiff_t count = std::ranges::count_if(label, begins_character);
  if (count <= most) return escape(label);
  const std::ptrdiff_t kept = most - 1, first = (kept + 1) / 2;
  std::string shortened;
  std::ptrdiff_t number = -1;
  for (const char c : label) {
    number += begins_character(c) ? 1 : 0;
    if (number == first && begins_character(c)) shortened += "…";
    if (number < first || number >= count - (kept - first)) shortened += c;
  }
  return fmt::format("<title>{}</title>{}", escape(label), escape(shortened));
}

PlotFrame::PlotFrame(std::string title, const Axis& x, const Axis& y, std::span<const double> xs,
                     std::span<const double> ys, double room, double least_area)
    : title_(std::move(title)),
      x_axis_(x),
      y_axis_(y),
      area_{left, top, width - room, std::max(least_height - bottom, top + least_area)},
      x_(x, xs, area_.left, area_.right),
      y_(y, ys, area_.bottom, area_.top) {}

std::string PlotFrame::svg(const std::string& drawn) const {
  const double height = area_.bottom + bottom;
  const double middle_x = (area_.left + area_.right) / 2, middle_y = (area_.top + area_.bottom) / 2;
  return fmt::format(
      "<div class='plot' tabindex='0'><svg viewBox='0 0 {} {}' role='img' aria-label='{}'>{}"
      "<path class='axis' d='M{:.1f} {:.1f}V{:.1f}H{:.1f}'/>"
      "<text class='axis-title' x='{:.1f}' y='{:.1f}' text-anchor='middle'>{}</text>"
      "<text class='axis-title' transform='translate(18 {:.1f}) rotate(-90)' text-anchor='middle'>{}</text>"
      "{}</svg></div>\n",
      width, height, escape(title_), grid(x_, y_, area_), area_.left, area_.top, area_.bottom, area_.right, middle_x,
      height - 12, axis_title(x_axis_), middle_y, axis_title(y_axis_), drawn);
}

}  // namespace penumbra::report

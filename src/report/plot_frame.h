#pragma once

#include <span>
#include <string>
#include <string_view>

#include "report/axis.h"

namespace penumbra::report {

// A box in the coordinates of a plot's drawing, y downwards.
struct Box {
  double left = 0, top = 0, right = 0, bottom = 0;

  bool overlaps(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  bool holds(const Box& other) const {
    return left <= other.left && other.right <= right && top <= other.top && other.bottom <= bottom;
  }
};

constexpr double font_size = 13;
// The estimated width of a text: the SVG is laid out before its font is known.
double text_width(std::string_view text);
// What an SVG's <text> holds for a label: one that has no room is without its middle, and its tooltip has all of it.
std::string label_text(std::string_view label, double room);

// What all plots share: the size of the drawing, and axes with grid and labels.
class PlotFrame {
 public:
  // `room` is the width that stays free to the right of the axes, `least_area` the least height between the axes' ends.
  PlotFrame(std::string title, const Axis& x, const Axis& y, std::span<const double> xs, std::span<const double> ys,
            double room, double least_area = 0);

  const Scale& x() const { return x_; }
  const Scale& y() const { return y_; }
  const Box& area() const { return area_; }
  // The <svg> element with the axes and, over them, `drawn`.
  std::string svg(const std::string& drawn) const;

 private:
  std::string title_;
  Axis x_axis_, y_axis_;
  Box area_;
  Scale x_, y_;
};

}  // namespace penumbra::report

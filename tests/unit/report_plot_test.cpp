#include "report/plot.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <set>

#include "report/plot_frame.h"

namespace penumbra::report {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::vector<std::string> labels_of(const std::vector<Tick>& ticks) {
  std::vector<std::string> labels;
  for (const Tick& tick : ticks) labels.push_back(tick.label);
  return labels;
}

using Labels = std::vector<std::string>;
using Indices = std::vector<std::size_t>;

TEST(ReportPlot, LinearTicksAreRoundNumbers) {
  EXPECT_EQ(labels_of(linear_ticks(0, 10, 5)), (Labels{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels_of(linear_ticks(0.13, 0.42, 6)), (Labels{"0.15", "0.20", "0.25", "0.30", "0.35", "0.40"}));
  EXPECT_EQ(labels_of(linear_ticks(-1, 1, 4)), (Labels{"\u22121.0", "\u22120.5", "0.0", "0.5", "1.0"}));
  EXPECT_EQ(labels_of(linear_ticks(3, 3, 4)), (Labels{"3"}));
  EXPECT_EQ(linear_ticks(0, 1e9, 5).size(), 6u);
}

TEST(ReportPlot, LogTicksArePowersOfTenOrFinerWhereThoseAreFew) {
  EXPECT_EQ(labels_of(log_ticks(0.9, 1100)), (Labels{"1", "10", "100", "1000"}));
  EXPECT_EQ(labels_of(log_ticks(0.8, 25)), (Labels{"1", "2", "5", "10", "20"}));
  EXPECT_EQ(labels_of(log_ticks(2.1, 2.9)), (Labels{"2.2", "2.4", "2.6", "2.8"}));
  EXPECT_EQ(labels_of(log_ticks(0.0008, 0.12)), (Labels{"0.001", "0.01", "0.1"}));
}

TEST(ReportPlot, AScaleHoldsItsValuesWithRoomToSpare) {
  const std::vector<double> values{1, 10, 100};
  const Scale log({.label = "x", .log = true}, values, 0, 200);
  EXPECT_NEAR(log.at(10), 100, 1e-9);
  EXPECT_GT(log.at(1), 0);
  EXPECT_LT(log.at(100), 200);
  const Scale down({.label = "y"}, values, 200, 0);  // as a picture's rows
  EXPECT_GT(down.at(1), down.at(100));
}

TEST(ReportPlot, AScaleShowsWhatItCan) {
  const std::vector<double> values{0, -3, infinity, std::nan(""), 5};
  const Scale log({.label = "x", .log = true}, values, 0, 1);
  EXPECT_TRUE(log.shows(5));
  for (const double value : {0.0, -3.0, infinity, std::nan("")}) EXPECT_FALSE(log.shows(value)) << value;
  EXPECT_NEAR(log.at(5), 0.5, 1e-9);
  EXPECT_FALSE(Scale({.label = "x"}, {}, 0, 1).ticks().empty());
}

TEST(ReportPlot, AnAxisOfWhatIsNeverNegativeDoesNotBeginBelowZero) {
  const std::vector<double> values{0, 10};
  EXPECT_EQ(Scale({.label = "x"}, values, 0, 100).at(0), 0);
}

TEST(ReportPlot, TheFrontHasWhatNothingBetters) {
  //                      best cost   dominated  front    dominated  best error
  const std::vector<Point> points{{1, 9}, {2, 9.5}, {3, 4}, {4, 4}, {8, 1}};
  EXPECT_EQ(pareto_front(points), (Indices{0, 2, 4}));
}

TEST(ReportPlot, TheFrontDoesNotDependOnTheOrder) {
  const std::vector<Point> points{{8, 1}, {4, 4}, {1, 9}, {3, 4}, {2, 9.5}};
  EXPECT_EQ(pareto_front(points), (Indices{2, 3, 0}));
}

TEST(ReportPlot, EqualsShareTheFrontAndWhatIsNoNumberIsNotOnIt) {
  const std::vector<Point> points{{1, 1}, {1, 1}, {0.5, infinity}, {std::nan(""), 0}};
  EXPECT_EQ(pareto_front(points), (Indices{0, 1}));
  EXPECT_TRUE(pareto_front({}).empty());
}

// The boxes of the labels in a plot's SVG.
std::vector<Box> label_boxes(const std::string& svg) {
  static const std::regex label("<text class='label[^']*' x='([-0-9.]+)' y='([-0-9.]+)'>([^<]*)</text>");
  std::vector<Box> boxes;
  for (std::sregex_iterator i(svg.begin(), svg.end(), label), end; i != end; ++i) {
    const double left = std::stod((*i)[1]), base = std::stod((*i)[2]);
    boxes.push_back({left, base - 0.7 * font_size, left + text_width((*i)[3].str()), base});
  }
  return boxes;
}

void expect_apart(const std::vector<Box>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(boxes[i].overlaps(boxes[k])) << i << " and " << k;
  }
}

TEST(ReportPlot, LabelsOfACrowdDoNotOverlap) {
  ScatterPlot plot{.title = "t", .x = {"x", "ms", true}, .y = {"y"}, .dots = {}};
  for (int i = 0; i < 14; ++i)
    plot.dots.push_back({.label = "technique_" + std::to_string(i), .tooltip = {}, .at = {10 + 0.1 * i, 5.0 + i % 3}});
  plot.dots.push_back({.label = "far", .tooltip = {}, .at = {1000, 50}});
  const std::vector<Box> boxes = label_boxes(to_html(plot).str());
  EXPECT_GE(boxes.size(), 3u);
  expect_apart(boxes);
}

TEST(ReportPlot, NamesAtTheEndsOfLinesDoNotOverlap) {
  LinePlot plot{.title = "t", .x = {"x"}, .y = {"y"}, .lines = {}};
  for (int i = 0; i < 9; ++i)
    plot.lines.push_back({.label = "line " + std::to_string(i), .points = {{0, 0}, {1, 1 + 0.001 * i}}});
  const std::vector<Box> boxes = label_boxes(to_html(plot).str());
  EXPECT_EQ(boxes.size(), 9u);
  expect_apart(boxes);
}

TEST(ReportPlot, FortyLinesCanBeToldApartAndHaveTheirNamesWithinThePlot) {
  LinePlot plot{.title = "t", .x = {"x"}, .y = {"y"}, .lines = {}};
  for (int i = 0; i < 40; ++i) plot.lines.push_back({.label = "line " + std::to_string(i), .points = {{0, 0}, {1, 1}}});
  const std::string svg = to_html(plot).str();
  const std::vector<Box> boxes = label_boxes(svg);
  EXPECT_EQ(boxes.size(), 40u);
  expect_apart(boxes);
  std::smatch size;
  ASSERT_TRUE(std::regex_search(svg, size, std::regex("viewBox='0 0 ([0-9.]+) ([0-9.]+)'")));
  const Box all{0, 0, std::stod(size[1]), std::stod(size[2])};
  for (const Box& box : boxes) EXPECT_TRUE(all.holds(box)) << box.left << ", " << box.top;
  static const std::regex name("<text class='label name ([^']*)'");
  std::set<std::string> looks;
  for (std::sregex_iterator i(svg.begin(), svg.end(), name), end; i != end; ++i) looks.insert((*i)[1]);
  EXPECT_EQ(looks.size(), 40u) << "8 colours with 5 patterns each";
}

TEST(ReportPlot, ALabelWithoutRoomLosesItsMiddleAndATooltipHasAllOfIt) {
  EXPECT_EQ(label_text("a<b", 100), "a&lt;b");
  const std::string label = "begin_" + std::string(60, 'x') + "_end";
  const std::string text = label_text(label, text_width("begin_..._end"));
  EXPECT_EQ(text, "<title>" + label + "</title>begin_\u2026xx_end");
  EXPECT_EQ(label_text("\u00e4\u00f6\u00fc\u00df\u00e4", text_width("123")),
            "<title>\u00e4\u00f6\u00fc\u00df\u00e4</title>\u00e4\u2026\u00e4")
      << "whole characters";
}

TEST(ReportPlot, LongNamesOfBarsAndLinesStayWithinThePlot) {
  const std::string name(80, 'i');
  const LinePlot lines{.title = "t", .x = {"x"}, .y = {"y"}, .lines = {{.label = name, .points = {{0, 0}, {1, 1}}}}};
  const BarPlot bars{.title = "t", .x = {.label = "x"}, .parts = {"a"}, .bars = {{.label = name, .values = {1}}}};
  static const std::regex label(
      "<text class='label[^']*' x='([-0-9.]+)' y='[-0-9.]+'[^>]*><title>i*</title>([^<]*)</text>");
  for (const std::string& svg : {to_html(lines).str(), to_html(bars).str()}) {
    std::smatch found;
    ASSERT_TRUE(std::regex_search(svg, found, label)) << svg;
    const double x = std::stod(found[1]), width = text_width(found[2].str());
    const bool ends_there = found[0].str().find("text-anchor='end'") != std::string::npos;
    EXPECT_GE(ends_there ? x - width : x, 0);
    EXPECT_LE(ends_there ? x : x + width, 760);
  }
}

TEST(ReportPlot, WhatALogAxisCannotShowIsNamedBelow) {
  const ScatterPlot plot{.title = "t",
                         .x = {"cost", "ms", true},
                         .y = {"error", "", true},
                         .dots = {{"some", "", {2, 0.1}}, {"the truth <itself>", "", {3, 0}}}};
  const std::string html = to_html(plot).str();
  EXPECT_NE(html.find("Off the plot: the truth &lt;itself&gt; (3 ms, 0)."), std::string::npos) << html;
  EXPECT_EQ(label_boxes(html).size(), 1u);
}

TEST(ReportPlot, EveryDotSaysWhatItIs) {
  const ScatterPlot plot{
      .title = "cost & error", .x = {"cost", "ms"}, .y = {"error"}, .dots = {{"a<b", "more", {2, 0.5}}}};
  const std::string html = to_html(plot).str();
  EXPECT_NE(html.find("<title>a&lt;b: 2 ms, 0.5\nmore</title>"), std::string::npos) << html;
  EXPECT_NE(html.find("aria-label='cost &amp; error'"), std::string::npos);
}

std::vector<double> numbers_of(const std::string& svg, const std::string& pattern) {
  const std::regex each(pattern);
  std::vector<double> numbers;
  for (std::sregex_iterator found(svg.begin(), svg.end(), each), end; found != end; ++found)
    numbers.push_back(std::stod((*found)[1]));
  return numbers;
}

TEST(ReportPlot, ABarsPartsLieEndToEndInProportion) {
  const BarPlot plot{.title = "costs",
                     .x = {.label = "time", .unit = "ms"},
                     .parts = {"a", "b <c>", "d"},
                     .bars = {{.label = "first", .values = {10, 20, 5}}, {.label = "second", .values = {10, 0, 40}}}};
  const std::string svg = to_html(plot).str();
  const std::vector<double> x = numbers_of(svg, "<rect[^>]* x='([0-9.]+)'");
  const std::vector<double> width = numbers_of(svg, "<rect[^>]* width='([0-9.]+)'");
  ASSERT_EQ(x.size(), 5u) << "nothing is drawn of a part that is 0";
  EXPECT_NEAR(width[1], 2 * width[0], 0.03);
  EXPECT_NEAR(width[2], 0.5 * width[0], 0.03);
  EXPECT_NEAR(width[4], 4 * width[3], 0.03);
  EXPECT_NEAR(width[3], width[0], 0.03) << "bars share a scale";
  EXPECT_NEAR(x[1], x[0] + width[0], 0.03);
  EXPECT_NEAR(x[2], x[1] + width[1], 0.03);
  EXPECT_EQ(x[3], x[0]);
  EXPECT_NE(svg.find("<title>first: b &lt;c&gt;, 20 ms</title>"), svg.npos);
  EXPECT_NE(svg.find(">35 ms</text>"), svg.npos) << "the sum";
}

TEST(ReportPlot, OfManyPartsTheLeastAreOneAndTheSumStays) {
  BarPlot plot{
      .title = "", .x = {.label = "time", .unit = "ms"}, .parts = {}, .bars = {{.label = "bar", .values = {}}}};
  for (int i = 1; i <= 12; ++i) {
    plot.parts.push_back("part " + std::to_string(i));
    plot.bars.front().values.push_back(i);
  }
  const std::string svg = to_html(plot).str();
  EXPECT_EQ(numbers_of(svg, "<rect[^>]* x='([0-9.]+)'").size(), 8u);
  EXPECT_NE(svg.find("bar: others, 15 ms"), svg.npos) << "1 + 2 + 3 + 4 + 5";
  EXPECT_NE(svg.find("bar: part 6, 6 ms"), svg.npos);
  EXPECT_NE(svg.find(">78 ms</text>"), svg.npos);
}

}  // namespace
}  // namespace penumbra::report

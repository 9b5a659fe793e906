#include "report/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

namespace penumbra::report {
namespace {

std::string html_of(const std::vector<Column>& columns, const std::vector<std::vector<Cell>>& rows) {
  return to_html(Table{.caption = "c", .columns = columns, .rows = rows}).str();
}

// Texts of the cells that are marked as the best of their column.
std::vector<std::string> best_of(const std::string& html) {
  static const std::regex cell("<td class='number best'[^>]*>([^<]*)<");
  std::vector<std::string> found;
  for (std::sregex_iterator i(html.begin(), html.end(), cell), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

std::string column_html(Best best, const std::vector<std::optional<double>>& values) {
  std::vector<std::vector<Cell>> rows;
  for (const std::optional<double>& value : values) rows.push_back({{"row"}, cell_of(value, 1)});
  return html_of({{"name"}, {.title = "value", .best = best}}, rows);
}

using Texts = std::vector<std::string>;
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(ReportTable, TheBestOfAColumnIsMarked) {
  EXPECT_EQ(best_of(column_html(Best::lowest, {3, 1, 2})), (Texts{"1.0"}));
  EXPECT_EQ(best_of(column_html(Best::highest, {3, 1, 2})), (Texts{"3.0"}));
  EXPECT_EQ(best_of(column_html(Best::nearest_zero, {-0.2, 0.5, -4})), (Texts{"\u22120.2"}));
  EXPECT_EQ(best_of(column_html(Best::none, {3, 1})), Texts{});
}

TEST(ReportTable, InfinityWinsAndWhatIsMissingDoesNotCount) {
  EXPECT_EQ(best_of(column_html(Best::highest, {3, infinity, std::nullopt})), (Texts{"∞"}));
  EXPECT_EQ(best_of(column_html(Best::lowest, {3, std::nan(""), 2})), (Texts{"2.0"}));
}

TEST(ReportTable, WhereAllAreAlikeThereIsNoBest) {
  EXPECT_EQ(best_of(column_html(Best::lowest, {2, 2})), Texts{});
  EXPECT_EQ(best_of(column_html(Best::lowest, {2})), Texts{});
  EXPECT_EQ(best_of(column_html(Best::lowest, {2, 2, 3})), (Texts{"2.0", "2.0"}));
}

TEST(ReportTable, CellsKeepTheirFullValueForSorting) {
  const std::string html = column_html(Best::none, {0.123456789, infinity, -infinity, std::nullopt});
  for (const char* key : {"data-value='0.123456789'", "data-value='Infinity'", "data-value='-Infinity'"})
    EXPECT_NE(html.find(key), std::string::npos) << key;
  EXPECT_NE(html.find("<td class='number'>–</td>"), std::string::npos);
}

TEST(ReportTable, TextIsEscaped) {
  const std::string html = html_of({{.title = "<a>", .unit = "<u>", .help = "'<h>'"}, {"b"}}, {{{"<i>"}, {"<td>&"}}});
  for (const char* part : {"&lt;a&gt;", "&lt;u&gt;", "title='&#39;&lt;h&gt;&#39;'", "&lt;i&gt;", "&lt;td&gt;&amp;"})
    EXPECT_NE(html.find(part), std::string::npos) << part;
}

HeatMap map_of(std::vector<double> values) {
  return {.caption = "cost",
          .row_title = "blocker taps",
          .column_title = "filter taps",
          .row_names = {"8", "32"},
          .column_names = {"8", "32"},
          .values = std::move(values),
          .unit = "ms",
          .decimals = 1};
}

// The background colours of the cells, in order.
std::vector<std::string> backgrounds(const std::string& html) {
  static const std::regex cell("background:(rgb\\([^)]*\\))");
  std::vector<std::string> found;
  for (std::sregex_iterator i(html.begin(), html.end(), cell), end; i != end; ++i) found.push_back((*i)[1]);
  return found;
}

TEST(ReportTable, AHeatMapIsDarkerForMore) {
  const std::string html = to_html(map_of({1, 2, 3, 5})).str();
  const Texts colours = backgrounds(html);
  ASSERT_EQ(colours.size(), 4u);
  EXPECT_EQ(colours[0], "rgb(255 247 224)");
  EXPECT_EQ(colours[1], "rgb(253 208 137)");
  EXPECT_EQ(colours[2], "rgb(240 138 84)");
  EXPECT_EQ(colours[3], "rgb(72 22 74)");
  EXPECT_NE(html.find("color:#111'>1.0<"), std::string::npos);
  EXPECT_NE(html.find("color:#fff'>5.0<"), std::string::npos);
}

TEST(ReportTable, AHeatMapCanHaveGaps) {
  const Texts colours = backgrounds(to_html(map_of({1, 2, 3, std::nan("")})).str());
  EXPECT_EQ(colours, (Texts{"rgb(255 247 224)", "rgb(240 138 84)", "rgb(72 22 74)"}));
}

TEST(ReportTable, AHeatMapOfOneValueIsInTheMiddle) {
  EXPECT_EQ(backgrounds(to_html(map_of({4, 4, 4, 4})).str()).front(), "rgb(240 138 84)");
}

}  // namespace
}  // namespace penumbra::report

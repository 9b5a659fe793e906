#include "report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "report/number.h"

namespace penumbra::report {

namespace {

// A value's distance from the best by the column's rule: less is better.
double badness(Best best, double value) {
  switch (best) {
    case Best::highest:
      return -value;
    case Best::nearest_zero:
      return std::abs(value);
    default:
      return value;
  }
}

// The best value of a column, as badness; nothing if all values are equal or none counts.
std::optional<double> best_of(const Table& table, std::size_t column) {
  const Best best = table.columns[column].best;
  std::vector<double> all;
  for (const std::vector<Cell>& row : table.rows) {
    const std::optional<double>& value = row[column].value;
    if (best != Best::none && value && !std::isnan(*value)) all.push_back(badness(best, *value));
  }
  if (all.size() < 2) return std::nullopt;
  const auto [least, most] = std::ranges::minmax(all);
  return least < most ? std::optional(least) : std::nullopt;
}

bool is_numeric(const Table& table, std::size_t column) {
  if (table.columns[column].best != Best::none) return true;
  return std::ranges::any_of(table.rows, [&](const std::vector<Cell>& row) { return row[column].value.has_value(); });
}

std::string head_cell(const Table& table, std::size_t i) {
  const Column& column = table.columns[i];
  const std::string unit = column.unit.empty() ? "" : fmt::format("<span class='unit'>{}</span>", escape(column.unit));
  const std::string help = column.help.empty() ? "" : fmt::format(" title='{}'", escape(column.help));
  return fmt::format("<th scope='col'{}><button type='button'{}>{}{}</button></th>",
                     is_numeric(table, i) ? " class='number'" : "", help, escape(column.title), unit);
}

// A number as JavaScript spells it.
std::string sort_key(double value) {
  if (std::isnan(value)) return "NaN";
  return std::isinf(value) ? (value > 0 ? "Infinity" : "-Infinity") : fmt::format("{}", value);
}

std::string body_cell(const Table& table, const Cell& cell, std::size_t i, const std::optional<double>& best) {
  if (i == 0) return fmt::format("<th scope='row'>{}</th>", escape(cell.text));
  const bool is_best = best && cell.value && badness(table.columns[i].best, *cell.value) == *best;
  std::string classes = is_numeric(table, i) ? "number" : "";
  if (is_best) classes += " best";
  const std::string key = cell.value ? fmt::format(" data-value='{}'", sort_key(*cell.value)) : "";
  return fmt::format("<td{}{}>{}{}</td>", classes.empty() ? "" : " class='" + classes + "'", key, escape(cell.text),
                     is_best ? "<span class='spoken'> (best)</span>" : "");
}

}  // namespace

Cell cell_of(std::optional<double> value, int decimals) { return {value ? fixed(*value, decimals) : "–", value}; }

Html to_html(const Table& table) {
  std::string head, body;
  std::vector<std::optional<double>> best;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    head += head_cell(table, i);
    best.push_back(best_of(table, i));
  }
  for (const std::vector<Cell>& row : table.rows) {
    assert(row.size() == table.columns.size());
    body += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) body += body_cell(table, row[i], i, best[i]);
    body += "</tr>\n";
  }
  return Html(
      fmt::format("<div class='table' tabindex='0'><table class='sortable'><caption><span>{}</span></caption>\n"
                  "<thead><tr>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n",
                  escape(table.caption), head, body));
}

}  // namespace penumbra::report

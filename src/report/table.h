#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/html.h"

namespace penumbra::report {

// Which cell of a column is marked as its best.
enum class Best { none, lowest, highest, nearest_zero };

struct Column {
  std::string title;
  std::string unit;  // shown below the title
  std::string help;  // one sentence: the title's tooltip
  Best best = Best::none;
};

struct Cell {
  std::string text;
  std::optional<double> value = {};  // the key for sorting, may be infinite; absent: sorted by the text
};

// A number with `decimals` decimals; a missing one is shown as "–" and sorted last.
Cell cell_of(std::optional<double> value, int decimals);

// A table that the reader can sort by clicking on a column's title.
struct Table {
  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  // the first cell is the row's title
};
Html to_html(const Table& table);

// Values over two parameters; the larger the value, the darker the cell.
struct HeatMap {
  std::string caption;
  std::string row_title, column_title;  // what the names below are of
  std::vector<std::string> row_names, column_names;
  std::vector<double> values;  // row by row; values that are not finite are shown as "–"
  std::string unit;
  int decimals = 2;
};
Html to_html(const HeatMap& map);

}  // namespace penumbra::report

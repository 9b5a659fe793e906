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
  std::string unit;  // under the title
  std::string help;  // one sentence: the title's tooltip
  Best best = Best::none;
};

struct Cell {
  std::string text;
  std::optional<double> value = {};  // what the column is sorted by, infinities included; cells without one by text
};

// A number with so many decimals; "–", which is sorted last, where there is none.
Cell cell_of(std::optional<double> value, int decimals);

// A table that its reader sorts by a click on a column's title.
struct Table {
  std::string caption;
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  // the first cell is the row's title
};
Html to_html(const Table& table);

// Values over two parameters, each cell coloured by its value, darker for more.
struct HeatMap {
  std::string caption;
  std::string row_title, column_title;  // what the names below are of
  std::vector<std::string> row_names, column_names;
  std::vector<double> values;  // row by row; not finite: "–"
  std::string unit;
  int decimals = 2;
  bool log = false;  // colours by the logarithm; values are then positive
};
Html to_html(const HeatMap& map);

}  // namespace penumbra::report

#include "viewer/detail.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <variant>
#include <vector>

namespace penumbra::viewer {

namespace {

constexpr int least_maps = 256;  // texels
constexpr int least_reads = 4, least_slices = 2;

void divide(ParamSet& params, const std::string& name, int divisor, int least) {
  const int value = params.get_int(name), allowed = static_cast<int>(params.row(name).min);
  params.set(name, std::max({value / divisor, std::min(value, least), allowed}));
}

// The technique's parameters that count something.
std::vector<Param> counts_of(const ParamSet& params, const std::string& technique) {
  std::vector<Param> counts;
  std::ranges::copy_if(params.rows(), std::back_inserter(counts), [&](const Param& row) {
    return row.name.starts_with(technique + ".") && std::holds_alternative<int>(row.default_value);
  });
  return counts;
}

}  // namespace

ParamSet reduced(const ParamSet& params, const Detail& detail) {
  const std::string& technique = params.get_word("technique");
  ParamSet result = params;
  if (technique == "truth") return result;
  if (detail.maps > 1) {
    const bool fewer = params.get_int("cascades.count") > 1;
    if (fewer) divide(result, "cascades.count", detail.maps, 1);
    divide(result, "cascades.size", fewer ? 2 : detail.maps, least_maps);
  }
  if (detail.reads == 1) return result;
  const std::vector<Param> rows = counts_of(params, technique);
  const bool in_slices = std::ranges::any_of(rows, [](const Param& row) { return row.unit == "slices"; });
  const int root = static_cast<int>(std::sqrt(detail.reads));
  for (const Param& row : rows) {
    if (row.unit == "taps" || row.unit == "rays") divide(result, row.name, detail.reads, least_reads);
    // What a pixel reads is the number of slices times that of the texels along each.
    if (row.unit == "slices" || (in_slices && row.unit == "texels")) divide(result, row.name, root, least_slices);
  }
  return result;
}

Detail effective(const ParamSet& params, const Detail& detail) {
  const ParamSet maps = reduced(params, {.maps = detail.maps}), reads = reduced(params, {.reads = detail.reads});
  Detail result = detail;
  if (maps == params) result.maps = 1;
  if (reads == params) result.reads = 1;
  return result;
}

}  // namespace penumbra::viewer

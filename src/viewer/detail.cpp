#include "viewer/detail.h"

#include <algorithm>
#include <string>

namespace penumbra::viewer {

namespace {

constexpr int least_maps = 256;  // texels
constexpr int least_reads = 4, least_slices = 2;

void divide(ParamSet& params, const std::string& name, int divisor, int least) {
  const int value = params.get_int(name), allowed = static_cast<int>(params.row(name).min);
  params.set(name, std::max({value / divisor, std::min(value, least), allowed}));
}

}  // namespace

ParamSet reduced(const ParamSet& params, const Detail& detail) {
  const std::string& technique = params.get_word("technique");
  ParamSet result = params;
  if (technique == "truth") return result;
  if (detail.maps > 1) divide(result, "cascades.size", detail.maps, least_maps);
  if (detail.reads == 1) return result;
  for (const Param& row : params.rows()) {
    if (!row.name.starts_with(technique + ".")) continue;
    if (row.unit == "taps" || row.unit == "rays") divide(result, row.name, detail.reads, least_reads);
  }
  if (technique == "slices") {
    // Their product is what a pixel reads.
    for (const char* name : {"slices.azimuths", "slices.samples"}) divide(result, name, detail.reads / 2, least_slices);
  }
  return result;
}

}  // namespace penumbra::viewer

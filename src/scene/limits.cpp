#include "scene/limits.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <vector>

#include "core/error.h"
#include "core/names.h"

namespace penumbra::scene {
namespace {

constexpr std::array rows{
    LimitRow{"file", "bytes of the glTF, of each buffer and of each image file", &ReadLimits::file_bytes, true},
    LimitRow{"images", "bytes of all images when decoded, four a pixel", &ReadLimits::image_bytes, true},
    LimitRow{"image-pixels", "pixels of an image", &ReadLimits::image_pixels},
    LimitRow{"data", "bytes of all other data when expanded and decompressed", &ReadLimits::decoded_bytes, true},
    LimitRow{"vertices", "vertices; each node that draws a skinned or morphed mesh has vertices of its own",
             &ReadLimits::vertices},
    LimitRow{"triangles", "triangles drawn in a frame", &ReadLimits::triangles},
    LimitRow{"instances", "primitives drawn in a frame", &ReadLimits::instances},
    LimitRow{"nodes", "nodes", &ReadLimits::nodes},
    LimitRow{"node-depth", "levels of nodes below one another", &ReadLimits::node_depth},
    LimitRow{"json-values", "values of the JSON text", &ReadLimits::json_values},
};

struct Unit {
  std::string_view text;
  std::size_t bytes;
};
constexpr std::array units{Unit{"GiB", std::size_t{1} << 30}, Unit{"MiB", std::size_t{1} << 20},
                           Unit{"KiB", std::size_t{1} << 10}};

const LimitRow& row_named(std::string_view name) {
  const auto found = std::ranges::find_if(rows, [&](const LimitRow& row) { return row.name == name; });
  if (found != rows.end()) return *found;
  std::vector<std::string> names;
  for (const LimitRow& row : rows) names.emplace_back(row.name);
  fail_unknown("limit", name, names);
}

// Of `unit`.
std::optional<std::size_t> whole_number(std::string_view digits, std::size_t unit) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  const bool whole = error == std::errc() && end == digits.data() + digits.size();
  if (!whole || number == 0 || number > std::numeric_limits<std::size_t>::max() / 64 / unit) return std::nullopt;
  return number * unit;
}

std::size_t number_of(const LimitRow& row, std::string_view text) {
  const std::optional<std::size_t> number = row.bytes ? bytes_from(text) : whole_number(text, 1);
  if (!number)
    fail("limit {}: '{}' is not a number of {}", row.name, text,
         row.bytes ? "bytes, as 1500000000, 1500MiB or 2GiB" : "one or more");
  return *number;
}

}  // namespace

std::optional<std::size_t> bytes_from(std::string_view text) {
  for (const Unit& unit : units) {
    if (text.ends_with(unit.text)) return whole_number(text.substr(0, text.size() - unit.text.size()), unit.bytes);
  }
  return whole_number(text, 1);
}

std::span<const LimitRow> limit_rows() { return rows; }

void set_limit(ReadLimits& limits, std::string_view assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string_view::npos) fail("limit '{}' is not NAME=VALUE", assignment);
  const LimitRow& row = row_named(assignment.substr(0, equals));
  limits.*row.value = number_of(row, assignment.substr(equals + 1));
  if (row.value != &ReadLimits::decoded_bytes) return;
  limits.decoded_ratio = 0;  // an explicit limit applies whatever the size of files and memory
  limits.decoded_most = limits.decoded_bytes;
}

std::string bytes_text(std::size_t bytes) {
  for (const Unit& unit : units) {
    if (bytes < unit.bytes) continue;
    std::string text = fmt::format("{:.1f}", static_cast<double>(bytes) / static_cast<double>(unit.bytes));
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return fmt::format("{} {}", text, unit.text);
  }
  return fmt::format("{} bytes", bytes);
}

void fail_over_limit(const std::string& what, const ReadLimits& limits, std::size_t ReadLimits::*value) {
  const LimitRow& row = *std::ranges::find_if(rows, [&](const LimitRow& r) { return r.value == value; });
  fail("{}, over the limit of {}; --limit {}={} changes it", what,
       row.bytes ? bytes_text(limits.*value) : fmt::format("{}", limits.*value), row.name, row.bytes ? "SIZE" : "N");
}

}  // namespace penumbra::scene

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "scene_check/checks.h"

namespace penumbra::test {
namespace {

struct Row {
  std::string file, kind;
};

struct Exception {
  std::string_view file, why;
};

// Files that the validator accepts and the reader refuses nevertheless.
constexpr std::array refused_though_valid = {
    Exception{"magnum/required-extensions.gltf", "requires the extension KHR_materials_pbrSpecularGlossiness"},
    Exception{"magnum/required-extensions-unsupported.gltf",
              "requires the extension KHR_materials_pbrSpecularGlossiness"},
};

// Made for this purpose with faults that matter; the exception's fault (wrong accessor bounds) is not relied upon.
constexpr std::string_view made_to_be_refused = "derived/";
constexpr std::string_view harmless = "derived/minmax_lie.glb";

// Valid but extreme files may be refused only because of a limit, which the message must name.
constexpr std::string_view stated_limit = "over the limit of", depth_limit = "deeper than the limit of";

std::vector<Row> read_manifest(const std::filesystem::path& path) {
  std::ifstream stream(path);
  std::vector<Row> rows;
  std::string line;
  std::getline(stream, line);  // heading
  while (std::getline(stream, line)) {
    const auto first = line.find(','), second = line.find(',', first + 1);
    if (second != std::string::npos)
      rows.push_back({line.substr(0, first), line.substr(first + 1, second - first - 1)});
  }
  return rows;
}

bool is_one_line_naming(const std::string& message, const std::string& file) {
  return message.find('\n') == std::string::npos && message.size() > file.size() &&
         message.find(file) != std::string::npos;
}

bool mentions_limit(const std::string& message) {
  return message.find(stated_limit) != std::string::npos || message.find(depth_limit) != std::string::npos;
}

// Why the outcome is not the one that the class demands; empty if it is.
std::string fault_of(const Row& row, const Reading& reading) {
  const bool refused = reading.outcome == Outcome::refused;
  if (refused && !is_one_line_naming(reading.message, row.file)) return "not one line naming the file";
  const auto exception = std::find_if(refused_though_valid.begin(), refused_though_valid.end(),
                                      [&](const Exception& e) { return e.file == row.file; });
  if (exception != refused_though_valid.end())
    return refused && reading.message.find(exception->why) != std::string::npos ? ""
                                                                                : "must be refused with its reason";
  if (row.kind.starts_with("valid")) return refused ? "must load" : "";
  if (row.kind == "legal_but_extreme") return refused && !mentions_limit(reading.message) ? "no limit is stated" : "";
  if (row.kind != "invalid") return "unknown class " + row.kind;
  const bool must = row.file.starts_with(made_to_be_refused) && row.file != harmless;
  return must && !refused ? "must be refused" : "";
}

}  // namespace

int check_bad_scenes(const std::filesystem::path& folder) {
  const std::vector<Row> rows = read_manifest(folder / "manifest.csv");
  int failures = 0, loaded = 0;
  for (const Row& row : rows) {
    std::string fault;
    Reading reading;
    start_hang_guard(row.file);
    try {
      reading = read_and_check(folder / row.file);
      fault = fault_of(row, reading);
    } catch (const std::exception& e) {
      fault = e.what();
    }
    if (reading.outcome == Outcome::loaded) ++loaded;
    if (fault.empty()) continue;
    ++failures;
    std::printf("FAILED: %s (%s): %s; %s\n", row.file.c_str(), row.kind.c_str(), fault.c_str(),
                reading.outcome == Outcome::loaded ? "it loaded" : reading.message.c_str());
  }
  if (rows.empty()) {
    std::printf("FAILED: no manifest\n");
    return 1;
  }
  std::printf("%zu files: %d loaded, %zu refused, %d failed\n", rows.size(), loaded,
              rows.size() - static_cast<std::size_t>(loaded), failures);
  return failures;
}

}  // namespace penumbra::test

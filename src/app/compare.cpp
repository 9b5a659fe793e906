#include <fmt/format.h>

#include <filesystem>

#include "app/commands.h"
#include "app/compare/comparison.h"
#include "app/compare/options.h"
#include "app/compare/page.h"
#include "app/compare/tables.h"
#include "app/techniques.h"
#include "io/output_file.h"
#include "studio/signals.h"
#include "studio/studio.h"

namespace penumbra::app {

namespace {

struct Outputs {
  std::filesystem::path page, csv, json;
};

Outputs outputs_of(const CompareOptions& options) {
  const std::filesystem::path folder = options.output;
  return {folder / "index.html", folder / "results.csv", folder / "results.json"};
}

// Before minutes of drawing.
void check_files(const CompareOptions& options, const Outputs& outputs) {
  for (const std::string& scene : options.scenes) {
    if (!std::filesystem::exists(scene)) fail("cannot read {}: there is no such file", io::quoted(scene));
  }
  for (const std::filesystem::path& path : {outputs.page, outputs.csv, outputs.json}) io::check_writable(path);
}

void print(const Comparison& comparison, const Outputs& outputs) {
  for (const ComparedScene& scene : comparison.scenes) {
    if (comparison.scenes.size() > 1) fmt::print("{}\n", scene.path);
    fmt::print("{}", terminal_table(scene));
  }
  fmt::print("wrote {}\n", outputs.page.string());
}

}  // namespace

int run_compare(const Arguments& arguments) {
  CompareOptions options;
  if (!parse_compare(arguments, options)) return 0;
  const Outputs outputs = outputs_of(options);
  studio::clean_up_on_signals();
  studio::limit_threads(options);
  const ComparedValues values = values_of(options, all_techniques());  // presets before scenes
  check_files(options, outputs);

  const Comparison comparison = compare(options, values);
  io::write_text(outputs.page, report::to_text(comparison_page(comparison, options, arguments)));
  io::write_text(outputs.csv, csv_table(comparison));
  io::write_text(outputs.json, io::text_of(json_of(comparison, options, arguments)));
  if (!options.quiet) print(comparison, outputs);
  return 0;
}

}  // namespace penumbra::app

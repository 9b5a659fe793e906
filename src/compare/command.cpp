#include <fmt/format.h>

#include <filesystem>

#include "cli/signals.h"
#include "compare/command.h"
#include "compare/comparison.h"
#include "compare/options.h"
#include "compare/page.h"
#include "compare/tables.h"
#include "io/output_file.h"
#include "session/render_session.h"
#include "session/techniques.h"

namespace penumbra::compare {

namespace {

struct Outputs {
  std::filesystem::path page, csv, json;
};

Outputs outputs_of(const CompareOptions& options) {
  const std::filesystem::path folder = options.output;
  return {folder / "index.html", folder / "results.csv", folder / "results.json"};
}

// Called before drawing, which can take minutes.
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

int run(const cli::Arguments& arguments) {
  CompareOptions options;
  if (!parse_compare(arguments, options)) return 0;
  const Outputs outputs = outputs_of(options);
  cli::clean_up_on_signals();
  session::limit_threads(options);
  const ComparedValues values = values_of(options, session::all_techniques());  // presets before scenes
  check_files(options, outputs);

  const Comparison comparison = compare(options, values);
  io::write_text(outputs.page, report::to_text(comparison_page(comparison, options, arguments)));
  io::write_text(outputs.csv, csv_table(comparison));
  io::write_text(outputs.json, io::text_of(json_of(comparison, options, arguments)));
  if (!options.quiet) print(comparison, outputs);
  return 0;
}

}  // namespace penumbra::compare

#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cli/no_effect.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "compare/command.h"
#include "compare/comparison.h"
#include "compare/options.h"
#include "compare/page.h"
#include "compare/reports.h"
#include "compare/tables.h"
#include "core/log.h"
#include "io/output_file.h"
#include "session/render_session.h"
#include "session/techniques.h"

namespace penumbra::compare {

namespace {

// Called before drawing, which can take minutes.
void check_files(const CompareOptions& options) {
  for (const std::string& scene : options.scenes) {
    if (!std::filesystem::exists(scene)) fail("cannot read {}: there is no such file", io::quoted(scene));
  }
  check_inputs(options, std::vector<std::filesystem::path>(options.scenes.begin(), options.scenes.end()));
  for (const std::filesystem::path& path : {options.page(), options.csv(), options.json()}) io::check_writable(path);
}

void print(const Comparison& comparison, const CompareOptions& options) {
  for (const ComparedScene& scene : comparison.scenes) {
    if (comparison.scenes.size() > 1) fmt::print("{}\n", cli::printable(scene.path));
    fmt::print("{}", terminal_table(scene));
  }
  fmt::print("wrote {}\n", cli::printable(options.page().string()));
}

void warn_of_values(const Comparison& comparison) {
  for (const ComparedScene& scene : comparison.scenes) {
    for (const ComparedTechnique& technique : scene.techniques) {
      if (technique.figures.not_finite > 0) warn("{}: {}", io::quoted(scene.path), not_finite_text(technique));
    }
  }
}

// In large parts, whatever those of the page are.
void write_page(const std::filesystem::path& path, const report::Page& page) {
  constexpr std::size_t large = std::size_t{1} << 20;
  io::OutputFile file(path);
  std::string part;
  report::write_text(page, [&](std::string_view text) {
    part += text;
    if (part.size() < large) return;
    file.append(part);
    part.clear();
  });
  file.append(part);
  file.commit();
}

}  // namespace

void warn_of_settings(const CompareOptions& options, const ComparedValues& values) {
  std::vector<ParamSet> drawn = values.contenders;
  drawn.push_back(values.reference);
  cli::warn_without_effect(options, drawn, session::all_techniques());
  cli::warn_of_rate(options);
  for (std::size_t i = 0; i < options.contenders.size(); ++i)
    cli::warn_without_effect(options.contenders[i].assignments, {&values.contenders[i], 1}, session::all_techniques());
}

void write_reports(Comparison& comparison, const CompareOptions& options, const cli::Arguments& arguments) {
  warn_of_values(comparison);
  write_page(options.page(), comparison_page(comparison, options, arguments));
  io::write_text(options.csv(), csv_table(comparison));
  io::write_text(options.json(), io::text_of(json_of(comparison, options, arguments)));
}

int run(const cli::Arguments& arguments) {
  CompareOptions options;
  if (!parse_compare(arguments, options)) return 0;
  cli::clean_up_on_signals();
  session::limit_threads(options);
  const ComparedValues values = values_of(options, session::all_techniques());  // presets before scenes
  check_files(options);
  warn_of_settings(options, values);
  options.reading.skies_chosen = cli::is_chosen(options, values.reference, "casters.skies");

  Comparison comparison = compare(options, values);
  write_reports(comparison, options, arguments);
  if (!options.quiet) print(comparison, options);
  return 0;
}

}  // namespace penumbra::compare

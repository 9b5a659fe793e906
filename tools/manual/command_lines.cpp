#include "manual/command_lines.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <optional>

#include "app/commands.h"
#include "app/diff/figures.h"
#include "app/names.h"
#include "bench/sweep.h"
#include "cli/help_reader.h"
#include "core/error.h"
#include "io/text.h"
#include "render/renderer.h"
#include "session/techniques.h"
#include "shadow/noise.h"
#include "shadow/sampling.h"

namespace penumbra::manual {

namespace {

using Words = std::vector<std::string>;

Words aov_names() {
  Words names;
  for (const render::Aov& aov : render::aovs()) names.push_back(aov.name);
  return names;
}

Words metric_names() {
  Words names;
  for (const app::Metric& metric : app::diff_metrics()) names.emplace_back(metric.name);
  return names;
}

// Options whose values are names that the program knows.
const std::map<std::string, Words>& known_words() {
  static const Words techniques = session::all_techniques().names();
  static const std::map<std::string, Words> known{{"--technique", techniques},
                                                  {"--preset", techniques},
                                                  {"--aov", aov_names()},
                                                  {"--sweep", bench::sweep_names()},
                                                  {"--metric", metric_names()},
                                                  {"--kind", shadow::noise_kinds()},
                                                  {"--pattern", shadow::pattern_names()},
                                                  {"WHAT", app::listing_names()},
                                                  {"NAME", app::explained_names()}};
  return known;
}

// "auto|on|off" as words; empty if it is not a list of words, which are in lower case.
Words words_of_type(const std::string& type) {
  const bool lower = std::ranges::all_of(type, [](char c) { return c == '|' || c == '_' || (c >= 'a' && c <= 'z'); });
  return lower && type.find('|') != std::string::npos ? io::split(type, '|') : Words();
}

void find_values(Option& option) {
  const auto known = known_words().find(option.names.back());
  option.words = known != known_words().end() ? known->second : words_of_type(option.type);
  const std::string& what = option.positional ? option.names.front() : option.type;
  if (what == "FILE|NAME")
    option.values = Values::presets;
  else if (what == "NAME=VALUE")
    option.values = Values::settings;
  else if (!option.words.empty())
    option.values = what == "NAME,..." ? Values::lists : Values::words;
  else if (what == "SCENE")
    option.values = Values::scenes;
  else if (what == "FILE" || what == "PLAN" || what == "A" || what == "B")
    option.values = Values::files;
  else if (what == "FOLDER" || what == "DIR" || what == "PATH")
    option.values = Values::folders;
  else
    option.values = Values::free;
}

Option option_of(const CLI::Option& option) {
  Option read;
  read.positional = option.get_positional();
  if (read.positional) {
    read.names = {option.get_name(/* positional= */ true)};
  } else {
    for (const std::string& name : option.get_snames()) read.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) read.names.push_back("--" + name);
  }
  read.type = option.get_type_name();
  read.help = option.get_description();
  if (!option.get_default_str().empty()) read.help += fmt::format(" ({})", option.get_default_str());
  read.required = option.get_required();
  read.repeatable = option.get_items_expected_max() > 1;
  if (option.get_items_expected_max() > 0) find_values(read);
  return read;
}

// The options that `penumbra NAME --help` lists.
CommandLine read(const app::Command& command, const std::string& part) {
  CommandLine line{.name = command.name, .summary = {}, .help = {}, .options = {}};
  app::Arguments arguments{"--help"};
  if (part.empty()) {
    line.summary = command.summary;
  } else {
    line.name += " " + part;
    arguments.insert(arguments.begin(), part);
  }
  bool found = false;
  cli::read_help_with([&](const CLI::App& options) {
    found = true;
    line.help = options.get_description();
    for (const CLI::Option* option : options.get_options())
      if (!option->get_group().empty()) line.options.push_back(option_of(*option));
  });
  command.run(arguments);
  if (!found) fail("penumbra {} --help has no options", line.name);
  return line;
}

// The first arguments that select a part of the command; none if it has no parts.
Words parts_of(std::string_view command) {
  if (command == "bake") return app::bake_kinds();
  if (command == "plan") return app::planned_commands();
  return {};
}

}  // namespace

std::vector<CommandLine> command_lines() {
  std::vector<CommandLine> lines;
  for (const app::Command& command : app::commands()) {
    const Words parts = parts_of(command.name);
    if (parts.empty()) {
      lines.push_back(read(command, ""));
      continue;
    }
    lines.push_back({.name = command.name, .summary = command.summary, .help = command.summary, .options = {}});
    for (const std::string& part : parts) lines.push_back(read(command, part));
    if (command.name == std::string_view("plan")) {
      const Option plan{.names = {"PLAN"},
                        .type = {},
                        .help = "Plan, .json",
                        .values = Values::files,
                        .words = {},
                        .positional = true,
                        .required = true};
      lines.push_back({.name = "plan show",
                       .summary = {},
                       .help = "Print what plan prints, of a plan that is there",
                       .options = {plan}});
    }
  }
  return lines;
}

}  // namespace penumbra::manual

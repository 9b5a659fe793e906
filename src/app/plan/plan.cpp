#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "app/commands.h"
#include "app/plan/jobs.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "cli/usage.h"
#include "io/output_file.h"

namespace penumbra::app {

namespace {

constexpr const char* usage =
    "Divide the work of a command into items, each of which `penumbra work` can draw on another machine.\n\n"
    "usage: penumbra plan compare|render|truth|bench [OPTIONS OF THAT COMMAND] -o PLAN.json\n"
    "       penumbra plan show PLAN.json\n\n"
    "The options are those of the command; penumbra plan COMMAND --help lists them, with those that only a plan has. "
    "It prints how many items there are, the seconds and the memory that the largest is expected to take, and the "
    "seconds of all of them. `show` prints the same of a plan.\n";

// Where the value of -o is among the arguments; the forms "-oX" and "--output=X" are split first.
std::optional<std::size_t> split_output(Arguments& arguments) {
  constexpr std::string_view short_name = "-o", long_name = "--output", with_equals = "--output=";
  std::optional<std::size_t> output;
  for (std::size_t i = 0; i < arguments.size() && arguments[i] != "--"; ++i) {
    const std::string argument = arguments[i];
    std::string_view rest;
    if (argument == short_name || argument == long_name) {
      if (i + 1 == arguments.size()) return std::nullopt;  // the command's parser says what is missing
    } else if (argument.starts_with(with_equals)) {
      rest = std::string_view(argument).substr(with_equals.size());
    } else if (argument.starts_with(short_name) && argument.size() > short_name.size()) {
      rest = std::string_view(argument).substr(short_name.size());
    } else if (argument.size() > 2 && argument[0] == '-' && argument[1] != '-' && argument.back() == 'o') {
      cli::fail_usage("{}: a plan's -o stands alone", argument);
    } else {
      continue;
    }
    if (!rest.empty()) {
      arguments[i] = argument.starts_with("--") ? long_name : short_name;
      arguments.insert(arguments.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::string(rest));
    }
    if (output) cli::fail_usage("-o is given twice: a plan is one file");
    output = ++i;
  }
  return output;
}

// A plan is JSON, so bytes of a name that are not UTF-8 would be lost.
void check_text(const std::string& name) {
  try {
    static_cast<void>(io::Json(name).dump());
  } catch (const io::Json::type_error&) {
    fail("a plan can't hold '{}', which is not UTF-8", cli::printable(name));
  }
}

plan::PlannedScene planned_scene(const std::string& path, const plan::SceneFacts& facts) {
  plan::PlannedScene scene{.path = path, .view = facts.view, .files = {}};
  for (const auto& [file, shader] : facts.files) {
    std::error_code unread;
    if (!std::filesystem::is_regular_file(file, unread)) continue;  // a scene may name files that it does not use
    const std::uintmax_t bytes = std::filesystem::file_size(file, unread);
    if (unread) fail("cannot read {}: {}", io::quoted(file), unread.message());
    check_text(file.string());
    try {
      scene.files.push_back({.path = file.string(), .bytes = bytes, .hash = io::key_of_file(file), .shader = shader});
    } catch (const Error& error) {
      fail("cannot read {}: {}", io::quoted(file), error.what());
    }
  }
  return scene;
}

void write_plan(const std::string& command, Arguments arguments) {
  const std::optional<std::size_t> output = split_output(arguments);
  const std::unique_ptr<plan::Job> job = make_job(command, arguments, output.value_or(0));
  if (!job) return;
  if (!output) cli::fail_usage("-o is required: the file of the plan");
  const std::filesystem::path path = arguments[*output];
  if (path.extension() != ".json") cli::fail_usage("-o {}: the name of a plan ends in .json", io::quoted(path));
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (i != *output) check_text(arguments[i]);
  }
  job->warn();
  cli::clean_up_on_signals();
  io::check_writable(path);

  plan::Plan plan{.program = this_program(), .command = command, .arguments = arguments, .output = *output};
  std::vector<plan::SceneFacts> facts;
  const std::vector<std::string> scenes = job->scenes();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    facts.push_back(job->facts(i));
    plan.scenes.push_back(planned_scene(scenes[i], facts.back()));
  }
  if (job->count() > plan::most_items)
    cli::fail_usage("{} items are more than a plan may have ({})", job->count(), plan::most_items);
  std::vector<io::Json> what;
  for (std::size_t i = 0; i < job->count(); ++i) {
    const std::size_t scene = job->scene_of(i);
    plan.items.push_back({.key = plan::key_of(plan.program, command, job->depends(i), plan.scenes[scene]),
                          .scene = scene,
                          .estimate = job->estimate(i, facts[scene])});
    what.push_back(job->what(i));
  }
  io::write_text(path, plan::text_of(plan, what));
  fmt::print("{}", counts_of(plan));
}

}  // namespace

int run_plan(const Arguments& arguments) {
  if (arguments.empty()) cli::fail_usage("plan lacks a command: compare, render, truth or bench");
  const std::string& command = arguments.front();
  if (command == "--help" || command == "-h") {
    fmt::print("{}", cli::wrapped(usage));
    return 0;
  }
  const Arguments rest(arguments.begin() + 1, arguments.end());
  if (command != "show") {
    write_plan(command, rest);
    return 0;
  }
  if (rest.size() != 1) cli::fail_usage("penumbra plan show takes one plan");
  fmt::print("{}", counts_of(read_job(rest.front()).plan));
  return 0;
}

}  // namespace penumbra::app

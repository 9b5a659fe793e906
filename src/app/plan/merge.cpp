#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "app/commands.h"
#include "app/plan/jobs.h"
#include "cli/input_files.h"
#include "cli/options.h"
#include "cli/output_names.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "io/output_file.h"
#include "plan/results.h"

namespace penumbra::app {

namespace {

namespace fs = std::filesystem;

struct MergeOptions {
  std::string plan, results, output;
  bool quiet = false;
};

// Prints each item that has no result, with the message of its failure. Returns how many these are.
std::size_t list_missing(const PlannedJob& planned, const plan::Results& results) {
  std::size_t missing = 0;
  for (std::size_t i = 0; i < planned.plan.items.size(); ++i) {
    const io::Key& key = planned.plan.items[i].key;
    if (results.has(key)) continue;
    ++missing;
    const std::string failure = results.failure(key);
    fmt::print("item {} ({}): {}\n", i, cli::printable(planned.job->name(i)),
               failure.empty() ? "not drawn" : "failed: " + cli::printable(failure));
  }
  return missing;
}

void check_outputs(const std::vector<fs::path>& outputs, const fs::path& plan_file, const plan::Plan& plan) {
  cli::InputFiles inputs;
  inputs.add("the plan", plan_file);
  for (const plan::PlannedScene& scene : plan.scenes) {
    for (const plan::PlannedFile& file : scene.files) inputs.add("the scene's file", file.path);
  }
  for (const fs::path& output : outputs) inputs.check("-o", output);
}

int merge(const MergeOptions& options) {
  const PlannedJob planned = read_job(options.plan);
  check_outputs(planned.job->outputs(options.output), options.plan, planned.plan);
  const plan::Results results(options.results.empty() ? plan::results_folder(options.plan) : fs::path(options.results),
                              planned.plan.command);
  if (const std::size_t missing = list_missing(planned, results); missing > 0)
    fail("{} of {} items of {} are missing in {}; penumbra work draws them", missing, planned.plan.items.size(),
         io::quoted(options.plan), io::quoted(results.folder()));
  const auto read = [&](std::size_t item) {
    std::optional<plan::Result> result = results.find(planned.plan.items[item].key);
    if (!result)
      fail("item {} ({}): its result {} is damaged; penumbra work draws it again", item, planned.job->name(item),
           io::quoted(results.file_of(planned.plan.items[item].key)));
    return std::move(*result);
  };
  const std::vector<fs::path> written = planned.job->merge(read, options.output);
  if (options.quiet) return 0;
  const std::string more = written.size() > 1 ? fmt::format(" and {} more", written.size() - 1) : "";
  fmt::print("wrote {}{}\n", cli::printable(written.front().string()), more);
  return 0;
}

}  // namespace

int run_merge(const Arguments& arguments) {
  CLI::App app("Write the report of a plan, as the whole command would have written it", "penumbra merge");
  MergeOptions options;
  app.add_option("PLAN", options.plan, "Plan, .json; see penumbra plan")->required()->type_name("");
  cli::add_value(app, "-o,--output", "FOLDER", "Folder for the report, or for the pictures",
                 [&options](const auto& text) { options.output = cli::output_folder("-o", text); });
  app.get_option("--output")->required();
  cli::add_value(app, "--results", "FOLDER", "Folder of the results (beside the plan: sweep.results of sweep.json)",
                 [&options](const auto& text) { options.results = text; });
  app.add_flag("--quiet,-q", options.quiet, "No summary")->disable_flag_override();
  if (!cli::parse(app, arguments)) return 0;
  cli::clean_up_on_signals();
  return merge(options);
}

}  // namespace penumbra::app

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>
#include <optional>
#include <set>
#include <string>

#include "app/commands.h"
#include "app/plan/jobs.h"
#include "cli/options.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "gl/shader_source.h"
#include "io/output_file.h"
#include "plan/results.h"

namespace penumbra::app {

namespace {

struct WorkOptions {
  std::string plan, results;
  std::optional<cli::FrameRange> items;  // absent: all
  std::optional<int> threads;
  bool quiet = false;
};

// Files and folders that were found to be as the plan says, so that each is read once only.
class CheckedFiles {
 public:
  // Throws Error unless each file of the scene is as it was when the plan was made.
  void check(const plan::PlannedScene& scene) {
    check_shaders(scene);
    for (const plan::PlannedFile& file : scene.files) {
      if (checked_.contains(file.path)) continue;
      std::error_code error;
      const std::uintmax_t bytes = std::filesystem::file_size(file.path, error);
      if (error) fail("cannot read {}: {}", io::quoted(file.path), error.message());
      if (bytes != file.bytes || hash_of(file.path) != file.hash)
        fail("{} is not as it was when the plan was made: plan again", io::quoted(file.path));
      checked_.insert(file.path);
    }
  }

 private:
  // A file that was added since may take the place of one of the program's shaders.
  void check_shaders(const plan::PlannedScene& scene) {
    std::set<std::string> planned;
    std::string folder;
    for (const plan::PlannedFile& file : scene.files) {
      if (file.shader.empty()) continue;
      planned.insert(file.path);
      folder = file.path.substr(0, file.path.size() - file.shader.size());
    }
    if (planned.empty() || !checked_.insert(folder).second) return;
    for (const std::string& name : gl::ShaderFiles::built_in_names()) {
      const std::string file = folder + name;
      std::error_code error;
      if (!planned.contains(file) && std::filesystem::exists(file, error))
        fail("{} was not there when the plan was made: plan again", io::quoted(file));
    }
  }

  static io::Key hash_of(const std::string& path) {
    try {
      return io::key_of_file(path);
    } catch (const Error& error) {
      fail("cannot read {}: {}", io::quoted(path), error.what());
    }
  }

  std::set<std::string> checked_;
};

// From the first to the last item to work on.
cli::FrameRange range_of(const WorkOptions& options, std::size_t count) {
  const auto last = static_cast<int>(count) - 1;
  cli::FrameRange range = options.items.value_or(cli::FrameRange{0, last});
  if (range.first > last) fail("{} has no item {}: its items are 0 to {}", io::quoted(options.plan), range.first, last);
  range.last = std::min(range.last, last);  // the last share of an array job may be smaller
  return range;
}

class Worker {
 public:
  Worker(const WorkOptions& options, const PlannedJob& planned)
      : options_(options),
        planned_(planned),
        results_(options.results.empty() ? plan::results_folder(options.plan) : std::filesystem::path(options.results),
                 planned.plan.command) {}

  // Returns the exit code.
  int run() {
    const cli::FrameRange range = range_of(options_, planned_.plan.items.size());
    {
      cli::Progress progress("item", range.count(), !options_.quiet);
      for (int item = range.first; item <= range.last; ++item) {
        work(static_cast<std::size_t>(item));
        progress.step();
      }
    }
    if (!options_.quiet) fmt::print("{} done, {} there already, {} failed\n", done_, there_, failed_);
    if (failed_ > 0)
      fail("{} of {} items failed, item {} first: {}", failed_, range.count(), first_failed_, first_message_);
    return 0;
  }

 private:
  void work(std::size_t item) {
    const plan::PlannedItem& planned = planned_.plan.items[item];
    check(item, planned);
    if (results_.find(planned.key)) {
      ++there_;
      return;
    }
    io::check_writable(results_.file_of(planned.key));
    plan::Result result;
    try {
      result = planned_.job->work(item);
    } catch (const std::bad_alloc&) {
      return failed(item, planned, "the system refused memory");
    } catch (const std::exception& error) {
      return failed(item, planned, error.what());
    }
    results_.keep(planned.key, result);
    ++done_;
  }

  // What would be wrong with every item ends the program.
  void check(std::size_t item, const plan::PlannedItem& planned) {
    const plan::PlannedScene& scene = planned_.plan.scenes[planned.scene];
    files_.check(scene);
    const io::Key key = plan::key_of(planned_.plan.program, planned_.plan.command, planned_.job->depends(item), scene);
    if (planned.scene != planned_.job->scene_of(item) || key != planned.key)
      fail("cannot use the plan {}: its item {} is not what its arguments give; plan again", io::quoted(options_.plan),
           item);
  }

  void failed(std::size_t item, const plan::PlannedItem& planned, const std::string& message) {
    const std::string line = cli::printable(message);
    results_.keep_failure(planned.key, line);
    if (failed_++ > 0) return;
    first_failed_ = item;
    first_message_ = line;
  }

  const WorkOptions& options_;
  const PlannedJob& planned_;
  plan::Results results_;
  CheckedFiles files_;
  int done_ = 0, there_ = 0, failed_ = 0;
  std::size_t first_failed_ = 0;
  std::string first_message_;
};

// An array job of Slurm gives each of its tasks a number.
void take_array_task(WorkOptions& options) {
  const char* task = std::getenv("SLURM_ARRAY_TASK_ID");
  if (options.items || task == nullptr) return;
  const int item = cli::parse_count("SLURM_ARRAY_TASK_ID", task, 0, static_cast<int>(plan::most_items));
  options.items = cli::FrameRange{item, item};
}

}  // namespace

int run_work(const Arguments& arguments) {
  CLI::App app("Draw items of a plan into a shared folder, and skip those that are there", "penumbra work");
  WorkOptions options;
  app.add_option("PLAN", options.plan, "Plan, .json; see penumbra plan")->required()->type_name("");
  cli::add_value(app, "--item", "N", "One item, from 0 (SLURM_ARRAY_TASK_ID if that is set, or else all)",
                 [&options](const auto& text) {
                   const int item = cli::parse_count("--item", text, 0, static_cast<int>(plan::most_items));
                   options.items = cli::FrameRange{item, item};
                 });
  cli::add_value(app, "--items", "FIRST:LAST", "Several items, the last one included",
                 [&options](const auto& text) { options.items = cli::parse_frames("--items", text); });
  app.get_option("--items")->excludes(app.get_option("--item"));
  cli::add_value(app, "--results", "FOLDER", "Folder of the results (beside the plan: sweep.results of sweep.json)",
                 [&options](const auto& text) { options.results = text; });
  cli::add_value(
      app, "--threads", "N",
      "Threads that draw, whatever the plan says; the results are the same (not for plans that measure times)",
      [&options](const auto& text) { options.threads = cli::parse_count("--threads", text, 1, 1024); });
  app.add_flag("--quiet,-q", options.quiet, "No progress and no summary")->disable_flag_override();
  if (!cli::parse(app, arguments)) return 0;
  take_array_task(options);
  cli::clean_up_on_signals();
  const PlannedJob planned = read_job(options.plan, options.threads);
  return Worker(options, planned).run();
}

}  // namespace penumbra::app

#include "app/plan/jobs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "app/names.h"
#include "app/render/job.h"
#include "app/truth/job.h"
#include "bench/bench.h"
#include "bench/machine.h"
#include "cli/usage.h"
#include "compare/command.h"
#include "image/probe.h"
#include "image/read.h"
#include "io/output_file.h"
#include "truth/technique.h"

namespace penumbra::app {

namespace {

shadow::Registry truth_techniques(int threads) { return truth::TruthTechnique({.threads = threads}).registry(); }

// A comparison measures costs unless it is told not to.
bool measures_times(const plan::Plan& plan) {
  const cli::Arguments arguments = plan.arguments_with("plan.json");
  return plan.command == "bench" ||
         (plan.command == "compare" && std::ranges::find(arguments, "--no-cost") == arguments.end());
}

// Behind what is there, so that the place of -o stays.
cli::Arguments with_threads(cli::Arguments arguments, std::optional<int> threads) {
  if (!threads) return arguments;
  const std::string name = "--threads", with_equals = name + "=", value = std::to_string(*threads);
  const auto end = std::ranges::find(arguments, "--");
  const auto given = std::find_if(arguments.begin(), end, [&](const std::string& argument) {
    return argument == name || argument.starts_with(with_equals);
  });
  if (given == end) {
    arguments.insert(end, {name, value});
  } else if (*given != name) {
    *given = with_equals + value;
  } else if (given + 1 != end) {
    *(given + 1) = value;
  }
  return arguments;
}

}  // namespace

const std::vector<std::string>& planned_commands() {
  static const std::vector<std::string> names{"compare", "render", "truth", "bench"};
  return names;
}

// A commit says what the program is, unless its sources differed or are unknown.
plan::Program this_program() {
  plan::Program program{.version = cli::version(), .commit = bench::commit()};
  io::Hasher hasher;
  hasher.add(program.version + " " + program.commit);
  const bool differs = program.commit.ends_with("-changed") || program.commit == "unknown";
  if (differs) hasher.add(io::key_of_file("/proc/self/exe").text());
  program.build = hasher.key();
  return program;
}

std::unique_ptr<plan::Job> make_job(const std::string& command, const cli::Arguments& arguments, std::size_t output,
                                    std::optional<std::size_t> items) {
  if (command == "compare") return compare::make_job(arguments, output);
  if (command == "render") return make_render_job(arguments);
  if (command == "truth") return make_truth_job(arguments);
  if (command == "bench") {
    return bench::make_job(arguments, output,
                           {.decoder = image::image_decoder,
                            .probe = [](const scene::ReadAt& file) { return image::probe(file); },
                            .techniques = [](int threads) { return truth_techniques(threads); }},
                           items);
  }
  cli::fail_unknown_usage("command that can be planned", command, planned_commands());
}

PlannedJob read_job(const std::filesystem::path& path, std::optional<int> threads) {
  PlannedJob read{.plan = plan::read_plan(path, this_program()), .job = nullptr};
  try {
    if (threads && measures_times(read.plan))
      fail("times depend on --threads, which belongs to the plan that measures them");
    // The value of -o matters only to `merge`, but must not be empty.
    read.job = make_job(read.plan.command, with_threads(read.plan.arguments_with("plan.json"), threads),
                        read.plan.output, read.plan.items.size());
    if (!read.job) fail("its arguments ask for help");
    if (read.job->count() != read.plan.items.size() || read.job->scenes().size() != read.plan.scenes.size())
      fail("its arguments give {} items on {} scenes, but it has {} on {}", read.job->count(),
           read.job->scenes().size(), read.plan.items.size(), read.plan.scenes.size());
  } catch (const Error& error) {
    fail("cannot use the plan {}: {}", io::quoted(path), error.what());
  }
  return read;
}

std::string counts_of(const plan::Plan& plan) {
  const plan::Estimate most = plan.largest();
  return fmt::format("items {}\nseconds {:.0f}\nmemory_mib {:.0f}\ntotal_seconds {:.0f}\n", plan.items.size(),
                     std::ceil(most.seconds), std::ceil(most.memory_mib), std::ceil(plan.total_seconds()));
}

}  // namespace penumbra::app

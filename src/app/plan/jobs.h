#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "cli/command_line.h"
#include "plan/job.h"
#include "plan/plan.h"

namespace penumbra::app {

// This program, as plans and results name it.
plan::Program this_program();

// The job of a command line, whose value of -o is at `output`. `items`: how many the plan has; absent: it is being
// planned. Null if the user asked for help. Throws UsageError for a command that can't be planned, and what the command
// throws.
std::unique_ptr<plan::Job> make_job(const std::string& command, const cli::Arguments& arguments, std::size_t output,
                                    std::optional<std::size_t> items = {});

// A plan that was read, with its job.
struct PlannedJob {
  plan::Plan plan;
  std::unique_ptr<plan::Job> job;
};
// `threads`: instead of those that the plan says. Throws Error, which names the plan, also if the command line in it is
// wrong or has other items.
PlannedJob read_job(const std::filesystem::path& path, std::optional<int> threads = {});

// What `plan` prints, for scripts: a name and a number in each line.
std::string counts_of(const plan::Plan& plan);

}  // namespace penumbra::app

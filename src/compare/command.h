#pragma once

#include <cstddef>
#include <memory>

#include "cli/command_line.h"
#include "plan/job.h"

namespace penumbra::compare {

// `penumbra compare`: parses the arguments, draws, measures and writes the page and the tables. Returns the exit
// code; throws UsageError or Error.
int run(const cli::Arguments& arguments);

// The same work, divided into items: without costs, one technique on one scene; with costs, all techniques on one
// scene, since they are timed in turn. Nothing if the user asked for help. `arguments` have the value of -o at
// `output`.
std::unique_ptr<plan::Job> make_job(const cli::Arguments& arguments, std::size_t output);

}  // namespace penumbra::compare

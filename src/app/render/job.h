#pragma once

#include <memory>

#include "cli/command_line.h"
#include "plan/job.h"

namespace penumbra::app {

// The work of `penumbra render`, divided into items of some frames each. Null if the user asked for help.
std::unique_ptr<plan::Job> make_render_job(const cli::Arguments& arguments);

}  // namespace penumbra::app

#pragma once

#include "cli/command_line.h"

namespace penumbra::viewer {

// `penumbra view`: parses the arguments and shows the window until it is closed. Returns the exit
// code; throws UsageError or Error.
int run(const cli::Arguments& arguments);

}  // namespace penumbra::viewer

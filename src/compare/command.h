#pragma once

#include "cli/command_line.h"

namespace penumbra::compare {

// `penumbra compare`: parses the arguments, draws, measures and writes the page and the tables. Returns the exit
// code; throws UsageError or Error.
int run(const cli::Arguments& arguments);

}  // namespace penumbra::compare

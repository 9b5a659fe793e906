#pragma once

#include "cli/command_line.h"

namespace penumbra::reproduce {

// `penumbra reproduce`: parses the arguments, makes the figures and writes the page and the tables. Returns the exit
// code; throws UsageError or Error.
int run(const cli::Arguments& arguments);

}  // namespace penumbra::reproduce

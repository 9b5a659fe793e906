#pragma once

#include "cli/cli_fwd.h"

namespace penumbra::cli {

// Puts the options of a command that has many under headings, for --help. Those with a heading of their own keep it,
// and hidden ones stay hidden. A command with few options keeps a single list.
void group_options(CLI::App& options);

}  // namespace penumbra::cli

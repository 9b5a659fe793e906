#pragma once

#include <functional>

#include "cli/cli_fwd.h"

namespace penumbra::cli {

// From now on parse() gives the options of --help to `reader`, instead of printing them: so the manual is made.
void read_help_with(std::function<void(const CLI::App& options)> reader);

}  // namespace penumbra::cli

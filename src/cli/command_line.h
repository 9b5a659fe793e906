#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/cli_fwd.h"

namespace penumbra::cli {

using Arguments = std::vector<std::string>;

// Parses a command's options, --log-level among them, which takes effect. False: --help was asked for and printed.
// Throws UsageError: one line, with near names for an unknown option.
bool parse(CLI::App& options, const Arguments& arguments);

// Runs a program: exceptions become one line on stderr and an exit code (0, 1 failed, 2 wrong usage), and so does a
// standard output that took not all.
int run_guarded(const std::function<int()>& program);

// "Penumbra 0.1.0"
std::string version();

}  // namespace penumbra::cli

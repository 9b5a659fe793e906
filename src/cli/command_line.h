#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/cli_fwd.h"

namespace penumbra::cli {

using Arguments = std::vector<std::string>;

// Parses a command's options, and adds and applies --log-level. False: --help was asked for and printed. Behind "--"
// nothing is an option. Throws UsageError: one line, with near names for an unknown option, and with "./" for a file
// whose name begins with a dash.
bool parse(CLI::App& options, const Arguments& arguments);

// Runs a program and returns its exit code. An exception becomes one line on stderr and the code 2 (UsageError) or 1
// (all others; memory and threads that the system refuses are told with the limit in force). So does a standard output
// that could not be written to its end: 1.
int run_guarded(const std::function<int()>& program);

// "Penumbra 0.1.0"
std::string version();

}  // namespace penumbra::cli

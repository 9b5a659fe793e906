#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/cli_fwd.h"

namespace penumbra::cli {

using Arguments = std::vector<std::string>;

// Parses a command's options, and adds and applies --log-level. Returns false if the user asked for --help, which is
// then printed. Arguments after "--" are never options. Throws UsageError with one line, which suggests similar names
// for an unknown option, and a leading "./" for a file whose name begins with a dash.
bool parse(CLI::App& options, const Arguments& arguments);

// Runs a program and returns its exit code. An exception becomes one line on stderr and the code 2 (UsageError) or 1
// (all others). If the system refused memory or a thread, the line names the limit in force. The code is also 1 if
// standard output could not be written completely.
int run_guarded(const std::function<int()>& program);

// "Penumbra 0.1.0"
std::string version();

}  // namespace penumbra::cli

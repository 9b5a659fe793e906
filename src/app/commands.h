#pragma once

#include <span>
#include <string>
#include <vector>

#include "app/cli_fwd.h"

namespace penumbra::app {

using Arguments = std::vector<std::string>;  // after the sub-command's name

// A sub-command: main.cpp calls run() by name. Returns the exit code; throws UsageError or Error.
struct Command {
  const char* name;
  const char* summary;
  int (*run)(const Arguments& arguments);
};
std::span<const Command> commands();

int run_render(const Arguments& arguments);
int run_bake(const Arguments& arguments);
int run_list(const Arguments& arguments);
int run_help(const Arguments& arguments);
int run_info(const Arguments& arguments);
int run_doctor(const Arguments& arguments);

// The whole program: dispatch, and exceptions to one line on stderr and an exit code (0, 1 failed, 2 wrong usage).
int run_program(const Arguments& arguments);

// Parses a sub-command's options, --log-level among them, which takes effect. False: --help was asked for and printed.
// Throws UsageError: one line, with near names for an unknown option.
bool parse(CLI::App& options, const Arguments& arguments);

// "Penumbra 0.1.0"
std::string version();

}  // namespace penumbra::app

#pragma once

#include <span>

#include "cli/command_line.h"

namespace penumbra::app {

using cli::Arguments;  // after the sub-command's name

// A sub-command: main.cpp calls run() by name. Returns the exit code; throws UsageError or Error.
struct Command {
  const char* name;
  const char* summary;
  int (*run)(const Arguments& arguments);
};
std::span<const Command> commands();

int run_render(const Arguments& arguments);
int run_watch(const Arguments& arguments);
int run_glsl(const Arguments& arguments);
int run_plan(const Arguments& arguments);
int run_work(const Arguments& arguments);
int run_merge(const Arguments& arguments);
int run_truth(const Arguments& arguments);
int run_diff(const Arguments& arguments);
int run_bake(const Arguments& arguments);
int run_list(const Arguments& arguments);
int run_help(const Arguments& arguments);
int run_info(const Arguments& arguments);
int run_doctor(const Arguments& arguments);

// The whole program: dispatch, and exceptions to one line on stderr and an exit code (0, 1 failed, 2 wrong usage).
int run_program(const Arguments& arguments);

}  // namespace penumbra::app

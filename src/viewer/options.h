#pragma once

#include <string>

#include "cli/options.h"
#include "session/cache_options.h"

namespace penumbra::viewer {

// What `penumbra view` was asked for; every value is parsed and in range.
struct ViewOptions : cli::SceneOptions, cli::ShadowOptions, cli::DeviceOptions, session::CacheOptions {
  bool sized = false;     // --size was given
  bool defaults = false;  // ignore the last run's settings, and save none
  std::string layout;     // file for the rectangles of widgets, for scripts
};

void add_view_command_options(CLI::App& app, ViewOptions& options);

// Throws UsageError where options that are right alone don't go together.
void check_together(const ViewOptions& options);

}  // namespace penumbra::viewer

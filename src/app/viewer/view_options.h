#pragma once

#include <string>

#include "app/cache_options.h"
#include "studio/options.h"

namespace penumbra::app {

// What `penumbra view` was asked for; every value is parsed and in range.
struct ViewOptions : studio::StageOptions, studio::ShadowOptions, studio::DeviceOptions, CacheOptions {
  bool sized = false;     // the window's size was given
  bool defaults = false;  // nothing of the last run is taken up
  std::string layout;     // a file for scripts: where widgets stand
};

void add_view_command_options(CLI::App& app, ViewOptions& options);

// Throws UsageError where options that are right alone don't go together.
void check_together(const ViewOptions& options);

}  // namespace penumbra::app

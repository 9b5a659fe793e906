#pragma once

#include <string>
#include <vector>

#include "cli/options.h"
#include "session/cache_options.h"

namespace penumbra::app {

// What `penumbra render` was asked for; every value is parsed and in range.
struct RenderOptions : cli::SceneOptions, cli::ShadowOptions, cli::DeviceOptions, session::CacheOptions {
  std::string output;
  int warmup = 0;
  bool warmup_still = false;  // at the time of the first frame, all of them
  std::string save_preset;
  std::vector<std::string> aovs;
  std::string stats;
  int stats_frames = 1;
  bool quiet = false;
};

void add_render_options(CLI::App& app, RenderOptions& options);

// Throws UsageError where options that are right alone don't go together.
void check_together(const RenderOptions& options);

}  // namespace penumbra::app

#pragma once

#include <string>

#include "cli/options.h"
#include "session/cache_options.h"

namespace penumbra::app {

// What `render` and `truth`, which write the frames of one scene, both have.
struct FrameOptions : cli::SceneOptions, cli::ShadowOptions, cli::DeviceOptions, session::CacheOptions {
  std::string output;
  bool quiet = false;
};

}  // namespace penumbra::app

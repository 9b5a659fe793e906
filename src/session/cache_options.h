#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "cli/cli_fwd.h"

namespace penumbra::session {

// Whether and where ray-traced shadows are kept between runs.
struct CacheOptions {
  std::optional<std::string> cache;
  bool no_cache = false;

  std::filesystem::path folder() const;  // empty: nothing is kept
};

void add_cache_options(CLI::App& app, CacheOptions& options);

// Throws cli::UsageError for --cache with --no-cache.
void check_together(const CacheOptions& options);

}  // namespace penumbra::session

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/cli_fwd.h"

namespace penumbra::session {

// Whether and where ray-traced shadows are kept between runs.
struct CacheOptions {
  std::optional<std::string> cache;
  bool no_cache = false;
  std::optional<std::size_t> cache_bytes;  // the most that all of it takes

  std::filesystem::path folder() const;  // empty: nothing is kept
};

void add_cache_options(CLI::App& app, CacheOptions& options);

// The options that say the same.
std::vector<std::string> cache_arguments(const CacheOptions& options);

// Throws cli::UsageError for --no-cache with --cache or --cache-size.
void check_together(const CacheOptions& options);

}  // namespace penumbra::session

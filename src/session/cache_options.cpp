#include "session/cache_options.h"

#include <CLI/CLI.hpp>

#include "cli/options.h"
#include "scene/limits.h"
#include "truth/cache.h"

namespace penumbra::session {

std::filesystem::path CacheOptions::folder() const {
  if (no_cache) return {};
  return cache ? std::filesystem::path(*cache) : truth::default_cache_folder();
}

void add_cache_options(CLI::App& app, CacheOptions& options) {
  cli::add_value(app, "--cache", "DIR", "Folder in which ray-traced shadows are kept ($XDG_CACHE_HOME/penumbra/truth)",
                 [&options](const auto& text) { options.cache = text; });
  cli::add_value(app, "--cache-size", "SIZE", "Most that the cache takes, such as 20GiB (1GiB)",
                 [&options](const auto& text) {
                   options.cache_bytes = scene::bytes_from(text);
                   if (!options.cache_bytes)
                     cli::fail_usage("--cache-size '{}' is not a number of bytes, as 1500MiB or 20GiB", text);
                 });
  app.add_flag("--no-cache", options.no_cache, "Neither look up nor keep ray-traced shadows")->disable_flag_override();
}

std::vector<std::string> cache_arguments(const CacheOptions& options) {
  std::vector<std::string> arguments;
  if (options.cache) arguments.push_back("--cache=" + *options.cache);
  if (options.cache_bytes) arguments.push_back("--cache-size=" + std::to_string(*options.cache_bytes));
  if (options.no_cache) arguments.emplace_back("--no-cache");
  return arguments;
}

void check_together(const CacheOptions& options) {
  if (options.cache && options.no_cache) cli::fail_usage("--cache and --no-cache exclude each other");
  if (options.cache_bytes && options.no_cache) cli::fail_usage("--cache-size and --no-cache exclude each other");
}

}  // namespace penumbra::session

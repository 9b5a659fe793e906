#include "cli/given.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>

namespace penumbra::cli {

std::vector<GivenOption> given_options(const CLI::App& options) {
  constexpr std::array<std::string_view, 8> without_effect{"--output", "--quiet",    "--log-level", "--threads",
                                                           "--cache",  "--no-cache", "--debug",     "--cache-size"};
  std::vector<GivenOption> given;
  for (const CLI::Option* option : options.get_options()) {
    if (option->count() == 0) continue;
    const std::string name = option->get_lnames().empty() ? option->get_name() : "--" + option->get_lnames().front();
    if (std::ranges::find(without_effect, name) == without_effect.end()) given.push_back({name, option->results()});
  }
  return given;
}

}  // namespace penumbra::cli

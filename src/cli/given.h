#pragma once

#include <string>
#include <vector>

#include "cli/cli_fwd.h"

namespace penumbra::cli {

// An option as the command line has it.
struct GivenOption {
  std::string name;  // "--size"
  std::vector<std::string> values;
};

// The options that a parsed command line has, in the order of their declaration, without those that do not change what
// is drawn (such as --quiet and --threads). Positional arguments have the name of their declaration ("SCENE").
std::vector<GivenOption> given_options(const CLI::App& options);

}  // namespace penumbra::cli

#pragma once

#include <span>
#include <string>

#include "manual/command_lines.h"

namespace penumbra::manual {

// The page penumbra(1) as roff: the commands with their options, and the names that options take.
std::string man_page(std::span<const CommandLine> commands);

}  // namespace penumbra::manual

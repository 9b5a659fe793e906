#pragma once

#include <span>
#include <string>

#include "manual/command_lines.h"

namespace penumbra::manual {

// Scripts that complete command lines of penumbra: for bash, and for zsh as the function _penumbra.
std::string bash_completion(std::span<const CommandLine> commands);
std::string zsh_completion(std::span<const CommandLine> commands);

}  // namespace penumbra::manual

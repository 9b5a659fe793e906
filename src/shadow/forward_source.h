#pragma once

#include <string>
#include <string_view>

namespace penumbra::shadow {

// Returns GLSL in which every name declared at global scope, including macros and members of uniform blocks, is renamed
// to begin with `prefix` wherever it is used, unless it already does. Includes must have been resolved.
std::string with_prefix(std::string_view glsl, std::string_view prefix);

// The text without its #version line: the program into which it is pasted has one.
std::string without_version(std::string_view glsl);

}  // namespace penumbra::shadow

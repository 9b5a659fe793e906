#pragma once

#include <string>
#include <string_view>

namespace penumbra::shadow {

// GLSL with every name that it declares at global scope, macros and members of uniform blocks included, renamed to
// begin with `prefix`, wherever it stands; names that begin so already stay. For text whose includes are resolved.
std::string with_prefix(std::string_view glsl, std::string_view prefix);

// The text without its #version, which the program that it is pasted into has of its own.
std::string without_version(std::string_view glsl);

}  // namespace penumbra::shadow

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace penumbra::cli {

// `text` with control characters replaced by spaces, so that names from a file can neither break a line nor send escape
// sequences to the terminal.
std::string printable(std::string text);

// "512 B", "3.4 KiB", "12.0 MiB"
std::string bytes_text(double bytes);

// A command as it can be typed into a shell: `program`, then each argument, quoted where it must be.
std::string command_text(std::string_view program, const std::vector<std::string>& arguments);

}  // namespace penumbra::cli

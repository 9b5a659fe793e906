#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra::cli {

// `text` with control characters replaced by spaces, so that names from a file can neither break a line nor send escape
// sequences to the terminal.
std::string printable(std::string text);

// "512 B", "3.4 KiB", "12.0 MiB"
std::string bytes_text(double bytes);

constexpr std::size_t terminal_columns = 100;

// Breaks lines at spaces so that none is wider than `columns`, unless a single word is. What follows a break is
// indented as the last column of the line is: behind the last two spaces in succession, or as the line itself.
std::string wrapped(std::string_view text, std::size_t columns = terminal_columns);

// A command as it can be typed into a shell: `program`, then each argument, quoted where it must be.
std::string command_text(std::string_view program, const std::vector<std::string>& arguments);

}  // namespace penumbra::cli

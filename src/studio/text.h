#pragma once

#include <string>

namespace penumbra::studio {

// `text` with control characters as spaces: names in a file can't break a line or steer the terminal.
std::string printable(std::string text);

// "512 B", "3.4 KiB", "12.0 MiB"
std::string bytes_text(double bytes);

}  // namespace penumbra::studio

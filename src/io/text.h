#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace penumbra::io {

// A field of comma-separated values (RFC 4180), quoted if it contains a comma, a quote or a line break. Bytes that
// are not UTF-8 become U+FFFD.
std::string csv_field(std::string_view text);

// The parts of `text` between the separators, in order: one part more than there are separators; parts may be empty.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace penumbra::io

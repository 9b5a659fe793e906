#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace penumbra::io {

// A field of comma-separated values (RFC 4180): what holds a comma, a quote or a line break stands in quotes.
std::string csv_field(std::string_view text);

// What stands between the separators, in order: one part more than there are separators, and parts may be empty.
std::vector<std::string> split(std::string_view text, char separator);

}  // namespace penumbra::io

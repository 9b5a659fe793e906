#pragma once

#include <cstddef>
#include <string_view>

namespace penumbra {

// The length of the UTF-8 sequence at the start of `text`; 0 if there is no valid one (RFC 3629, section 4).
std::size_t utf8_length(std::string_view text);

}  // namespace penumbra

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace penumbra {

// `text` with the letters A to Z as a to z.
std::string lower_case(std::string_view text);

// The candidates nearest to `name` by edit distance, best first, at most three; empty when nothing is near.
std::vector<std::string> near_names(std::string_view name, std::span<const std::string> candidates);

// Throws Error: unknown <kind> 'name'; did you mean 'a' or 'b'? (or, with nothing near, lists all candidates).
[[noreturn]] void fail_unknown(std::string_view kind, std::string_view name, std::span<const std::string> candidates);

}  // namespace penumbra

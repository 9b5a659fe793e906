#include "names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "error.h"

namespace penumbra {
namespace {

// Edits that turn a into b, where an edit inserts, removes or replaces a character or swaps two neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before_last, last(b.size() + 1), now(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before_last[j - 2] + 1);
    }
    before_last = std::exchange(last, now);
  }
  return last[b.size()];
}

// Distance for ranking; a part of the candidate ("taps" of "pcss.filter_taps") is as near as one edit.
std::size_t distance(std::string_view name, std::string_view candidate) {
  const std::size_t edits = edit_distance(name, candidate);
  const bool is_part = name.size() >= 3 && candidate.find(name) != std::string_view::npos;
  return is_part ? std::min<std::size_t>(edits, 1) : edits;
}

// How many letters of both names together have no partner in the other.
std::size_t unlike_letters(std::string_view a, std::string_view b) {
  std::array<int, 256> counts{};
  for (const char c : a) ++counts[static_cast<unsigned char>(c)];
  for (const char c : b) --counts[static_cast<unsigned char>(c)];
  return std::accumulate(counts.begin(), counts.end(), std::size_t{0},
                         [](std::size_t sum, int count) { return sum + static_cast<std::size_t>(std::abs(count)); });
}

std::string quoted_list(std::span<const std::string> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += fmt::format("'{}'", names[i]);
  }
  return text;
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

std::vector<std::string> near_names(std::string_view name, std::span<const std::string> candidates) {
  const std::string wanted = lower_case(name);
  const std::size_t limit = std::max<std::size_t>(1, wanted.size() / 3);
  std::vector<std::pair<std::size_t, std::string>> near;
  for (const std::string& candidate : candidates) {
    const std::string other = lower_case(candidate);
    // A short name in which two letters are wrong may still consist of nearly the same letters.
    const std::size_t edits = distance(wanted, other);
    const bool alike = wanted.size() == other.size() && wanted.size() >= 4 && unlike_letters(wanted, other) <= 2;
    if (edits <= limit || (edits == 2 && alike)) near.emplace_back(edits, candidate);
  }
  std::ranges::stable_sort(near, {}, &std::pair<std::size_t, std::string>::first);
  std::vector<std::string> names;
  for (auto& [edits, candidate] : near) {
    if (names.size() < 3) names.push_back(std::move(candidate));
  }
  return names;
}

void fail_unknown(std::string_view kind, std::string_view name, std::span<const std::string> candidates) {
  const std::vector<std::string> near = near_names(name, candidates);
  if (!near.empty()) fail("unknown {} '{}'; did you mean {}?", kind, name, quoted_list(near));
  if (candidates.empty()) fail("unknown {} '{}'; there are none", kind, name);
  fail("unknown {} '{}'; known: {}", kind, name, fmt::join(candidates, ", "));
}

}  // namespace penumbra

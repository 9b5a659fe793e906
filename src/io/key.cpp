#define XXH_INLINE_ALL
#include "io/key.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <vector>

#include "core/read_file.h"

namespace penumbra::io {

std::string Key::text() const { return fmt::format("{:016x}{:016x}", high, low); }

std::optional<Key> key_from(std::string_view text) {
  constexpr std::size_t half = 16;
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (text.size() != 2 * half || !std::ranges::all_of(text, is_digit)) return std::nullopt;
  const auto number = [](std::string_view digits) {
    std::uint64_t value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    return value;
  };
  return Key{number(text.substr(0, half)), number(text.substr(half))};
}

struct Hasher::State {
  struct Free {
    void operator()(XXH3_state_t* allocated) const { XXH3_freeState(allocated); }
  };
  std::unique_ptr<XXH3_state_t, Free> hash{XXH3_createState()};
};

Hasher::Hasher() : state_(std::make_unique<State>()) { XXH3_128bits_reset(state_->hash.get()); }

Hasher::~Hasher() = default;

void Hasher::add(std::span<const std::byte> bytes) {
  XXH3_128bits_update(state_->hash.get(), bytes.data(), bytes.size());
}

void Hasher::add(std::string_view text) { add(std::as_bytes(std::span(text))); }

Key Hasher::key() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->hash.get());
  return {hash.high64, hash.low64};
}

Key key_of_file(const std::filesystem::path& path) {
  FileParts file(path, std::numeric_limits<std::size_t>::max());
  Hasher hasher;
  std::vector<std::byte> part(std::size_t{1} << 20);
  for (std::size_t at = 0;;) {
    const std::size_t read = file.read(at, part);
    hasher.add(std::span(part).first(read));
    at += read;
    if (read < part.size()) return hasher.key();
  }
}

}  // namespace penumbra::io

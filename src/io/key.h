#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace penumbra::io {

// A 128-bit hash of everything that a result depends on.
struct Key {
  std::uint64_t high = 0, low = 0;
  bool operator==(const Key&) const = default;
  std::string text() const;  // 32 hexadecimal digits
};

// The key of that text; nothing if it is not 32 hexadecimal digits in lower case.
std::optional<Key> key_from(std::string_view text);

// XXH3 (Collet), 128 bits, of bytes that are added in parts. How they are divided makes no difference.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  void add(std::span<const std::byte> bytes);
  void add(std::string_view text);
  Key key() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// The key of a file's content, of which only a small part is in memory at a time. Throws Error, as read_file() does.
Key key_of_file(const std::filesystem::path& path);

}  // namespace penumbra::io

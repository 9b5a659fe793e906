#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "truth/tracer.h"

namespace penumbra::truth {

// All that a traced picture depends on, as 128 bits.
struct Key {
  std::uint64_t high = 0, low = 0;
  bool operator==(const Key&) const = default;
  std::string text() const;  // 32 hexadecimal digits
};

// The casters' part of the key: triangles, where they are, and what their alpha is made of.
Key key_of(const scene::Scene& scene, const scene::PosedGeometry& geometry);
// The picture's.
Key key_of(const Key& casters, std::span<const Receiver> receivers, int width, const Light& light,
           const TraceOptions& options);

// Of a picture's values, to know them again.
Key key_of(const Traced& traced);

// Traced pictures on disk: a file each, named by its key, that appears whole or not at all. What can't be read or is
// damaged counts as absent, and what can't be written is told in a warning, for a cache is no result.
class Cache {
 public:
  // `folder` is made when it is needed; empty: nothing is found or kept. Its files have no more than `largest` bytes
  // together: those least recently used go first.
  explicit Cache(std::filesystem::path folder, std::uintmax_t largest = 1ULL << 30)
      : folder_(std::move(folder)), largest_(largest) {}

  std::optional<Traced> find(const Key& key, std::size_t pixels) const;
  void keep(const Key& key, const Traced& traced) const;

 private:
  std::filesystem::path folder_;
  std::uintmax_t largest_;
};

// $XDG_CACHE_HOME/penumbra/truth, else $HOME/.cache/penumbra/truth, else empty.
std::filesystem::path default_cache_folder();

}  // namespace penumbra::truth

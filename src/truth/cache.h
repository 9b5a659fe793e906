#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "truth/tracer.h"

namespace penumbra::truth {

// A 128-bit hash of everything that a traced picture depends on.
struct Key {
  std::uint64_t high = 0, low = 0;
  bool operator==(const Key&) const = default;
  std::string text() const;  // 32 hexadecimal digits
};

// The casters' part of the key: triangles, their transforms, and what determines their alpha.
Key key_of(const scene::Scene& scene, const scene::PosedGeometry& geometry);
// The key of a picture.
Key key_of(const Key& casters, std::span<const Receiver> receivers, int width, const TracedLight& light,
           const TraceOptions& options);

// A checksum of a traced picture's values.
Key key_of(const Traced& traced);

// Cache of traced pictures on disk: one file each, named by its key and written atomically. A file that is damaged or
// can't be read counts as absent. A failure to write is only a warning, because the picture itself is still valid.
class Cache {
 public:
  // `folder` is created when first needed; empty: nothing is found or kept. Its files take at most `largest` bytes
  // together: the least recently used are deleted first.
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

#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <utility>

#include "io/key.h"
#include "truth/tracer.h"

namespace penumbra::truth {

using io::Key;  // of everything that a traced picture depends on

// The casters' part of the key: triangles, their transforms, and what determines their alpha.
Key key_of(const scene::Scene& scene, const scene::PosedGeometry& geometry);
// The key of a picture.
Key key_of(const Key& casters, std::span<const Receiver> receivers, int width, const TracedLight& light,
           const TraceOptions& options);

// A checksum of a traced picture.
Key key_of(const Traced& traced);

// Cache of traced pictures on disk: one file each, named by its key and written atomically. A file that is damaged or
// can't be read counts as absent. A failure to write is only a warning, because the picture itself is still valid.
class Cache {
 public:
  static constexpr std::uintmax_t usual_bytes = 1ULL << 30;

  // `folder` is created when first needed; empty: nothing is found or kept. Its files take at most `largest` bytes
  // together: the least recently used are deleted first. Several processes may use one folder, also on several
  // machines: each of those that write at the same moment can exceed the limit by its one file, until the next is
  // written. A temporary of the last hour is never deleted, since another process may be writing it.
  explicit Cache(std::filesystem::path folder, std::uintmax_t largest = usual_bytes)
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

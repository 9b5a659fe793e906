#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "scene/image_header.h"
#include "scene/scene.h"

namespace penumbra::scene {

// Decodes images for the reader, which does not know image formats itself.
class ImageDecoder {
 public:
  // Decodes an encoded image (PNG, JPEG, …) to 8-bit RGBA; throws Error with the cause. `name` is for the message.
  using Decode = std::function<Image(std::span<const std::byte> encoded, const std::string& name)>;

  ImageDecoder(Decode decode, ImageProbe probe) : decode_(std::move(decode)), probe_(std::move(probe)) {}
  // Implicit, so that a function can be passed where a decoder is expected. Without a probe, limits are checked only as
  // images are decoded.
  template <class Callable>
  requires(!std::same_as<std::remove_cvref_t<Callable>, ImageDecoder> && std::constructible_from<Decode, Callable>)
      // NOLINTNEXTLINE(bugprone-forwarding-reference-overload,google-explicit-constructor)
      ImageDecoder(Callable&& decode)
      : decode_(std::forward<Callable>(decode)) {}

  Image operator()(std::span<const std::byte> encoded, const std::string& name) const { return decode_(encoded, name); }
  const ImageProbe& probe() const { return probe_; }

 private:
  Decode decode_;
  ImageProbe probe_;
};

// Whether the reader uses a glTF extension, if only a part of it.
bool reads_extension(std::string_view name);

// Limits which ensure that no file can exhaust memory or time. If a file exceeds one, reading throws Error that names
// the limit. limits.h has the names by which `--limit` changes them.
struct ReadLimits {
  std::size_t file_bytes = std::size_t{1} << 30;  // each of: the glTF, a buffer, an image file
  std::size_t json_values = 5'000'000;            // objects, arrays and their members
  std::size_t json_depth = 256;                   // fixed, because JSON parsers are recursive
  // Totals of the whole scene after expansion. Each node that draws a skinned or morphed mesh counts its own vertices.
  std::size_t vertices = 50'000'000;
  std::size_t triangles = 250'000'000;  // drawn in a frame, counted for each node and instance
  std::size_t instances = 2'000'000;    // drawn in a frame: each primitive of a node for each instance of the node
  std::size_t nodes = 1'000'000;
  std::size_t node_depth = 1024;
  std::size_t image_pixels = std::size_t{1} << 26;  // of each image
  std::size_t image_bytes = std::size_t{4} << 30;   // of all decoded images together, four bytes a pixel
  // The limit for all other expanded and decompressed data grows with the file: a small file may not use much memory,
  // while a large one may legitimately need many times its size. It is min(decoded_bytes + decoded_ratio × bytes of all
  // files that were read, decoded_most).
  std::size_t decoded_bytes = std::size_t{1} << 30;
  std::size_t decoded_ratio = 16;
  std::size_t decoded_most = SIZE_MAX;  // bytes
  double extent = 1e9;                  // metres from the origin: beyond it, float arithmetic in the passes overflows
};

// How far the reading of a scene has come.
struct ReadProgress {
  const char* part = "";            // "mesh", "image": what is counted
  std::size_t done = 0, count = 0;  // parts of this kind: read, and in all
};

struct ReadOptions {
  ReadLimits limits;
  // Files beside the scene may be symbolic links that lead out of its folder.
  bool follow_links = false;
  // Called repeatedly on the thread that reads. An exception that it throws ends the reading.
  std::function<void(const ReadProgress&)> progress = {};
  // Called once the glTF's JSON is read, with the files that it names besides itself and may read, used or not, also
  // those that then can't be read.
  using NamesFiles = std::function<void(const std::vector<std::filesystem::path>&)>;
  NamesFiles names_files = {};
};

// Reads a .gltf or .glb with all files that it refers to. Throws Error: one line that names the file and the fault.
// Files outside the scene's own folder are refused. Images that no material uses are neither decoded nor kept. Only the
// default scene's nodes, and what they use, are drawn; parts with a fault that nothing drawn uses are left out, with a
// warning that names their place. The size of all images is checked before the first one is decoded.
Scene read_gltf(const std::filesystem::path& path, const ImageDecoder& decode, const ReadOptions& options = {});

}  // namespace penumbra::scene

#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "scene/image_header.h"
#include "scene/scene.h"

namespace penumbra::scene {

// How the reader gets at images, whose formats it does not know.
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

// Stated limits, so that no file can exhaust memory or time. Past one, reading throws Error that names it. limits.h has
// the names by which `--limit` changes them.
struct ReadLimits {
  std::size_t file_bytes = std::size_t{1} << 30;  // the glTF, each buffer and each image file
  std::size_t json_values = 5'000'000;            // objects, arrays and their members
  std::size_t json_depth = 256;                   // fixed: parsers of JSON recurse
  // After expansion, of the whole scene; each node that draws a skinned or morphed mesh has vertices of its own.
  std::size_t vertices = 50'000'000;
  std::size_t triangles = 250'000'000;  // drawn in a frame: those of each node and instance count
  std::size_t instances = 2'000'000;    // drawn in a frame: a primitive of a node, for each place of the node
  std::size_t nodes = 1'000'000;
  std::size_t node_depth = 1024;
  std::size_t image_pixels = std::size_t{1} << 26;  // each
  std::size_t image_bytes = std::size_t{4} << 30;   // of all images decoded, four a pixel
  // What all other data may grow to when expanded and decompressed: a small file can't ask for much, while a large one
  // may need many times its size.
  std::size_t decoded_bytes = std::size_t{1} << 30;  // plus
  std::size_t decoded_ratio = 16;                    // times the bytes of the files read, but
  std::size_t decoded_most = SIZE_MAX;               // at most
  double extent = 1e9;  // metres from the origin in the rest pose: beyond, float arithmetic of the passes overflows
};

// How far the reading of a scene is.
struct ReadProgress {
  const char* part = "";            // "mesh", "image": what there are `count` of
  std::size_t done = 0, count = 0;  // of this part
};

struct ReadOptions {
  ReadLimits limits;
  // Files beside the scene may be symbolic links that lead out of its folder.
  bool follow_links = false;
  // Called now and then, on the thread that reads. What it throws ends the reading.
  std::function<void(const ReadProgress&)> progress;
};

// Reads .gltf or .glb with all it refers to. Throws Error: one line that names the file and the fault. Files outside
// the scene's own folder are refused. Images that no material uses are neither decoded nor kept. Faults of what nothing
// drawn refers to (the default scene's nodes, and what they use, are drawn) are no faults of the scene: such parts are
// left out, with a warning that names their place. The size of all images is checked before the first is decoded.
Scene read_gltf(const std::filesystem::path& path, const ImageDecoder& decode, const ReadOptions& options = {});

}  // namespace penumbra::scene

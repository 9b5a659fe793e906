#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "scene/scene.h"

namespace penumbra::scene {

// Decodes an encoded image (PNG, JPEG, …) to 8-bit RGBA; throws Error with the cause. `name` is for the message.
using ImageDecoder = std::function<Image(std::span<const std::byte> encoded, const std::string& name)>;

// Stated limits, so that hostile files can't exhaust memory. Past one, reading throws Error naming it.
struct ReadLimits {
  std::size_t file_bytes = std::size_t{1} << 30;  // the glTF, each buffer and each image file
  std::size_t json_values = 5'000'000;            // objects, arrays and their members
  std::size_t json_depth = 256;
  std::size_t vertices = 50'000'000;  // after expansion, whole scene
  std::size_t nodes = 1'000'000;
  std::size_t node_depth = 1024;
  std::size_t image_pixels = std::size_t{1} << 26;  // each
  // What all data may grow to when expanded, decompressed and decoded: a small file can't ask for much, while a large
  // one may need many times its size.
  std::size_t decoded_bytes = std::size_t{1} << 30;  // plus
  std::size_t decoded_ratio = 16;                    // times the bytes of the files read
  double extent = 1e9;  // metres from the origin in the rest pose: beyond, float arithmetic of the passes overflows
};

// Reads .gltf or .glb with all it refers to. Throws Error: one line that names the file and the fault. Files outside
// the scene's own folder are refused. Images that no material uses are neither decoded nor kept.
Scene read_gltf(const std::filesystem::path& path, const ImageDecoder& decode, const ReadLimits& limits = {});

}  // namespace penumbra::scene

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
  std::size_t file_bytes = std::size_t{1} << 30;  // the glTF and each buffer
  std::size_t vertices = 50'000'000;              // after expansion, whole scene
  std::size_t nodes = 1'000'000;
  std::size_t node_depth = 1024;
  std::size_t json_depth = 256;
  std::size_t image_pixels = std::size_t{1} << 26;  // each
};

// Reads .gltf or .glb with all it refers to. Throws Error: one line that names the file and the fault. Files outside
// the scene's own folder are refused.
Scene read_gltf(const std::filesystem::path& path, const ImageDecoder& decode, const ReadLimits& limits = {});

}  // namespace penumbra::scene

#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

#include "scene/gltf.h"

namespace penumbra::scene::gltf {

using Bytes = std::span<const std::byte>;

// A .gltf or .glb file split into its parts: well-formed, but not yet validated.
struct Container {
  std::vector<std::byte> file;
  nlohmann::json json;
  Bytes binary;  // the GLB's BIN chunk, inside `file`
  bool has_binary = false;
};

// Reads a file and detects from its content whether it is GLB or JSON. Lengths, nesting and number of values are
// checked before anything is allocated.
Container read_container(const std::filesystem::path& path, const ReadLimits& limits);

}  // namespace penumbra::scene::gltf

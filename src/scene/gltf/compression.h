#pragma once

#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "scene/gltf/accessor.h"
#include "scene/gltf/document.h"

namespace penumbra::scene::gltf {

// A compressed bufferView (EXT_meshopt_compression).
struct MeshoptStream {
  Bytes bytes;
  std::size_t count = 0, stride = 0;
  std::string mode, filter;
};

// count × stride bytes; throws Error when the stream is damaged.
std::vector<std::byte> decode_meshopt(const MeshoptStream& stream);

// A decompressed primitive: a triangle list, and accessors by semantic that refer to its own bytes.
struct DracoMesh {
  std::vector<uint32_t> indices;
  std::map<std::string, AccessorView> attributes;
  std::vector<std::vector<std::byte>> storage;
};

// `extension`: the primitive's KHR_draco_mesh_compression. Throws Error when the stream is damaged or does not hold
// what the accessors promise.
DracoMesh decode_draco(Document& document, const tinygltf::Primitive& primitive, const tinygltf::Value& extension);

}  // namespace penumbra::scene::gltf

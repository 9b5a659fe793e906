#include "scene/gltf/container.h"

#include <cstdint>
#include <string_view>

#include "core/error.h"
#include "scene/gltf/resources.h"
#include "scene/limits.h"

namespace penumbra::scene::gltf {
namespace {

constexpr uint32_t glb_magic = 0x46546C67, json_chunk = 0x4E4F534A, bin_chunk = 0x004E4942;

uint32_t little_endian_32(Bytes bytes, std::size_t offset) {
  uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value |= std::to_integer<uint32_t>(bytes[offset + i]) << (8 * i);
  return value;
}

struct GlbChunks {
  Bytes json, binary;
  bool has_binary = false;
};

GlbChunks split_glb(Bytes file) {
  if (file.size() < 20) fail("GLB of {} bytes is shorter than its header", file.size());
  if (const uint32_t version = little_endian_32(file, 4); version != 2) fail("GLB version {}, not 2", version);
  const std::size_t length = little_endian_32(file, 8);
  if (length > file.size()) fail("GLB header says {} bytes, the file has {}", length, file.size());
  GlbChunks chunks;
  bool first = true;
  for (std::size_t at = 12; at < length;) {
    if (length - at < 8) fail("GLB ends inside a chunk header");
    const std::size_t size = little_endian_32(file, at);
    const uint32_t type = little_endian_32(file, at + 4);
    at += 8;
    if (size % 4 != 0) fail("GLB chunk of {} bytes is not a multiple of 4", size);
    if (size > length - at) fail("GLB chunk of {} bytes, only {} are left", size, length - at);
    if (first != (type == json_chunk)) fail("GLB must have one JSON chunk, and it must come first");
    if (first) chunks.json = file.subspan(at, size);
    if (type == bin_chunk) {
      if (chunks.has_binary) fail("GLB has more than one BIN chunk");
      chunks.has_binary = true;
      chunks.binary = file.subspan(at, size);
    }
    first = false;
    at += size;
  }
  if (chunks.json.empty()) fail("GLB has an empty JSON chunk");
  return chunks;
}

// Malicious JSON exploits recursive parsers by nesting and memory by many small values, so both are counted first,
// without recursion or allocation.
void check_json_size(std::string_view text, const ReadLimits& limits) {
  std::size_t depth = 0, values = 0;
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == ',' || c == ':') ++values;
    if (c == '{' || c == '[') {
      ++values;
      if (++depth > limits.json_depth) fail("JSON is nested deeper than the limit of {}", limits.json_depth);
    }
    if ((c == '}' || c == ']') && depth > 0) --depth;
    if (values > limits.json_values)
      fail_over_limit(fmt::format("JSON of {} or more values", values), limits, &ReadLimits::json_values);
  }
}

// An object, after white space or a byte order mark.
bool looks_like_json(Bytes bytes) {
  for (const std::byte byte : bytes) {
    const auto c = std::to_integer<unsigned char>(byte);
    if (c == '{') return true;
    if (c != ' ' && c != '\t' && c != '\r' && c != '\n' && c != 0xEF && c != 0xBB && c != 0xBF) return false;
  }
  return false;
}

nlohmann::json parse_json(Bytes bytes, const ReadLimits& limits) {
  // UTF-8 text is stored as it is in the file, so the bytes are its characters.
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  check_json_size(text, limits);
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& e) {
    std::string_view cause = e.what();
    // Remove the library's prefix "[json.exception.parse_error.101] ", which means nothing to the user.
    if (const auto bracket = cause.find("] "); bracket != std::string_view::npos) cause.remove_prefix(bracket + 2);
    fail("not valid JSON: {}", cause);
  }
}

}  // namespace

Container read_container(const std::filesystem::path& path, const ReadLimits& limits) {
  Container container;
  container.file = load_file(path, limits);
  const Bytes file = container.file;
  if (file.empty()) fail("the file is empty");
  if (file.size() >= 4 && little_endian_32(file, 0) == glb_magic) {
    const GlbChunks chunks = split_glb(file);
    container.json = parse_json(chunks.json, limits);
    container.binary = chunks.binary;
    container.has_binary = chunks.has_binary;
  } else {
    if (!looks_like_json(file)) fail("neither a GLB nor a glTF file");
    container.json = parse_json(file, limits);
    // The data of a .gltf are in other files, so only the BIN chunk of a GLB needs the file's bytes later.
    container.file = {};
  }
  return container;
}

}  // namespace penumbra::scene::gltf

#include "image/precheck.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

#include "core/error.h"
#include "image/bytes.h"

namespace penumbra::image {
namespace {

constexpr std::size_t chunk_frame = 12;  // length and type before the data, checksum after

bool carries_pixels(std::string_view type) {
  constexpr std::array<std::string_view, 5> types = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  return std::find(types.begin(), types.end(), type) != types.end();
}

}  // namespace

std::vector<std::byte> pixel_chunks_of_png(std::span<const std::byte> encoded) {
  std::vector<std::byte> kept(encoded.begin(), encoded.begin() + png_signature.size());
  for (std::size_t at = png_signature.size(); at < encoded.size();) {
    if (encoded.size() - at < chunk_frame) fail("PNG ends inside a chunk");
    const std::size_t length = big_endian(encoded, at, 4);
    if (length > encoded.size() - at - chunk_frame) fail("PNG ends inside a chunk");
    const auto chunk = encoded.subspan(at, length + chunk_frame);
    std::array<char, 4> type{};
    std::memcpy(type.data(), chunk.data() + 4, type.size());
    const std::string_view name(type.data(), type.size());
    if ((at == png_signature.size()) != (name == "IHDR")) fail("PNG does not begin with its header");
    const bool optional = name[0] >= 'a' && name[0] <= 'z';  // by PNG's rule; decoders must understand all others
    if (carries_pixels(name) || !optional) {
      const auto* checked = reinterpret_cast<const Bytef*>(chunk.data() + 4);
      if (crc32(0, checked, static_cast<uInt>(length + 4)) != big_endian(chunk, length + 8, 4))
        fail("PNG chunk {} is damaged", name);
      kept.insert(kept.end(), chunk.begin(), chunk.end());
    }
    if (name == "IEND") return kept;
    at += chunk.size();
  }
  fail("PNG has no end");
}

}  // namespace penumbra::image

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/error.h"
#include "image/precheck.h"

namespace penumbra::image {
namespace {

// OpenEXR file layout: https://openexr.com/en/latest/OpenEXRFileLayout.html
constexpr std::uint32_t tiled = 0x200, deep = 0x800, multipart = 0x1000;
constexpr std::size_t values_per_pixel = 16;
constexpr std::int64_t largest_side = 1 << 15, largest_tile = 1 << 14;
constexpr std::size_t line_values = std::size_t{1} << 20;  // the library decodes up to 256 lines at once
constexpr std::size_t tile_values = std::size_t{1} << 24;  // unless the picture has as many: it decodes whole tiles

// Reads the header from front to back and checks that no read exceeds the file.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : rest_(bytes) {}

  std::span<const std::byte> take(std::size_t count) {
    if (count > rest_.size()) fail("EXR ends inside its header");
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }

  std::int32_t number() {
    std::uint32_t value = 0;
    const auto bytes = take(4);
    for (std::size_t i = 4; i-- > 0;) value = value << 8 | std::to_integer<std::uint32_t>(bytes[i]);
    return static_cast<std::int32_t>(value);
  }

  std::string name() {
    const auto end = std::find(rest_.begin(), rest_.end(), std::byte{0});
    const auto bytes = take(static_cast<std::size_t>(end - rest_.begin()));
    take(1);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

 private:
  std::span<const std::byte> rest_;
};

struct Header {
  std::int64_t width = 0, height = 0;
  std::size_t channels = 0, tile_pixels = 0;
  bool has_tiles() const { return tile_pixels > 0; }
};

std::size_t checked_channels(Reader value) {
  std::size_t count = 0;
  for (std::string name = value.name(); !name.empty(); name = value.name()) {
    value.take(8);  // pixel type, and the flag pLinear
    if (value.number() != 1 || value.number() != 1) fail("EXR channel '{}' has fewer pixels than the picture", name);
    ++count;
  }
  if (count == 0) fail("EXR without channels");
  return count;
}

void read_attribute(Header& header, const std::string& name, Reader value) {
  if (name == "dataWindow") {
    const std::int64_t left = value.number(), top = value.number();
    header.width = value.number() - left + 1;
    header.height = value.number() - top + 1;
  } else if (name == "channels") {
    header.channels = checked_channels(value);
  } else if (name == "tiles") {
    header.tile_pixels = 1;
    for (const char* side : {"wide", "high"}) {
      const std::int64_t pixels = value.number();
      if (pixels < 1 || pixels > largest_tile) fail("EXR with tiles {} pixels {}", pixels, side);
      header.tile_pixels *= static_cast<std::size_t>(pixels);
    }
  }
}

}  // namespace

void check_exr_header(std::span<const std::byte> encoded, std::size_t max_pixels) {
  Reader reader(encoded);
  reader.take(4);  // the signature
  const auto version = static_cast<std::uint32_t>(reader.number());
  if ((version & (deep | multipart)) != 0) fail("EXR of several parts or with deep data, which is not read");
  Header header;
  for (std::string name = reader.name(); !name.empty(); name = reader.name()) {
    reader.name();  // the type of the attribute, which its name implies
    const std::int32_t size = reader.number();
    if (size < 0) fail("EXR attribute '{}' has a size of {} bytes", name, size);
    read_attribute(header, name, Reader(reader.take(static_cast<std::size_t>(size))));
  }
  if (header.width < 1 || header.height < 1) fail("an image without pixels");
  if (header.channels == 0) fail("EXR without channels");
  if (((version & tiled) != 0) != header.has_tiles()) fail("EXR whose version field and header disagree about tiles");
  if (header.width > largest_side || header.height > largest_side)
    fail("{} x {} pixels, over the limit of {} a side", header.width, header.height, largest_side);
  check_pixels(header.width, header.height, max_pixels);
  const auto width = static_cast<std::size_t>(header.width), height = static_cast<std::size_t>(header.height);
  if (header.channels > line_values / width)
    fail("lines of {} pixels with {} channels, over the limit of {} values", width, header.channels, line_values);
  if (header.channels > values_per_pixel * max_pixels / (width * height))
    fail("{} x {} pixels with {} channels, over the limit of {} values", width, height, header.channels,
         values_per_pixel * max_pixels);
  if (header.tile_pixels * header.channels > std::max(width * height * header.channels, tile_values))
    fail("EXR of {} x {} pixels with tiles of {} pixels", width, height, header.tile_pixels);
}

}  // namespace penumbra::image

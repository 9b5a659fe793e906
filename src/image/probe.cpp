#include "image/probe.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "core/error.h"
#include "image/bytes.h"
#include "image/jpeg_segments.h"
#include "image/precheck.h"

namespace penumbra::image {
namespace {

constexpr std::uint32_t longest_side = 0x7FFFFFFF;  // PNG's own limit; JPEG stores a side in 16 bits

scene::ImageHeader header_of(std::uint32_t width, std::uint32_t height, int channels) {
  if (width == 0 || height == 0) fail("an image without pixels");
  if (width > longest_side || height > longest_side) fail("a size of {} x {} pixels is wrong", width, height);
  return {.width = static_cast<int>(width),
          .height = static_cast<int>(height),
          .channels = channels,
          .decoded_bytes = std::size_t{width} * height * 4};
}

// The bytes of a file one by one. Reads a window of them at a time, and not more windows than a generous number: a
// malicious file could be a terabyte of segments without a header.
class Window {
 public:
  explicit Window(const scene::ReadAt& file) : file_(file) {}

  // Nothing behind the end of the file.
  std::optional<std::uint8_t> at(std::size_t offset) {
    if (offset < first_ || offset >= first_ + count_) fill(offset);
    if (offset >= first_ + count_) return {};
    return std::to_integer<std::uint8_t>(bytes_[offset - first_]);
  }
  // The big-endian unsigned number of two bytes.
  std::optional<std::uint32_t> pair_at(std::size_t offset) {
    const auto high = at(offset);
    const auto low = at(offset + 1);
    if (!high || !low) return {};
    return std::uint32_t{*high} << 8 | *low;
  }

 private:
  void fill(std::size_t offset) {
    constexpr int most_fills = 1 << 16;
    if (++fills_ > most_fills) fail("JPEG has too much before its header");
    first_ = offset;
    count_ = file_(offset, bytes_);
  }

  const scene::ReadAt& file_;
  std::array<std::byte, 512> bytes_{};
  std::size_t first_ = 0, count_ = 0;
  int fills_ = 0;
};

// PNG specification, section 11.2.2: IHDR is the first chunk.
scene::ImageHeader probe_png(const scene::ReadAt& file) {
  std::array<std::byte, 33> head{};
  if (file(0, head) < head.size()) fail("PNG ends inside a chunk");
  const std::span<const std::byte> encoded(head);
  if (!starts_with(encoded.subspan(12), "IHDR") || big_endian(encoded, 8, 4) != 13)
    fail("PNG does not begin with its header");
  constexpr std::array<int, 7> channels{1, 0, 3, 3, 2, 0, 4};  // by colour type
  const auto color_type = big_endian(encoded, 25, 1);
  if (color_type >= channels.size() || channels[color_type] == 0) fail("PNG with colour type {}", color_type);
  return header_of(big_endian(encoded, 16, 4), big_endian(encoded, 20, 4), channels[color_type]);
}

// Where the next marker begins, from `offset` on: decoders skip fill bytes and stray bytes.
std::optional<std::size_t> next_marker(Window& file, std::size_t offset) {
  for (auto pair = file.pair_at(offset); pair; pair = file.pair_at(++offset)) {
    if (*pair > 0xFF00 && *pair < 0xFFFF) return offset;
  }
  return {};
}

// Skips the contents of all segments before the frame header.
scene::ImageHeader probe_jpeg(const scene::ReadAt& encoded) {
  Window file(encoded);
  for (auto at = next_marker(file, 0); at;) {
    const std::uint8_t marker = *file.at(*at + 1);
    if (marker == jpeg::start_of_scan) break;
    std::size_t size = 2;
    if (!jpeg::stands_alone(marker)) {
      const auto length = file.pair_at(*at + 2);
      if (!length) fail("JPEG ends inside a segment");
      if (*length < 2) fail("JPEG has a segment of a wrong length");
      size += *length;
      if (jpeg::is_frame_header(marker)) {
        if (size < 10) fail("JPEG ends inside its header");
        const auto height = file.pair_at(*at + 5), width = file.pair_at(*at + 7);
        const auto channels = file.at(*at + 9);
        if (!height || !width || !channels || !file.at(*at + size - 1)) fail("JPEG ends inside a segment");
        return header_of(*width, *height, *channels);
      }
      if (!file.at(*at + size - 1)) fail("JPEG ends inside a segment");
    }
    at = next_marker(file, *at + size);
  }
  fail("JPEG without a header");
}

}  // namespace

void check_pixels(std::int64_t width, std::int64_t height, std::size_t max_pixels) {
  if (static_cast<std::size_t>(height) > max_pixels / static_cast<std::size_t>(width))
    fail("{} x {} pixels, over the limit of {}", width, height, max_pixels);
}

scene::ImageHeader probe(const scene::ReadAt& file) {
  std::array<std::byte, 8> signature{};
  const std::span<const std::byte> begin(signature.data(), file(0, signature));
  if (starts_with(begin, png_signature)) return probe_png(file);
  if (starts_with(begin, jpeg_signature)) return probe_jpeg(file);
  fail("neither PNG nor JPEG");
}

scene::ImageHeader probe(std::span<const std::byte> encoded) { return probe(scene::reader_of(encoded)); }

}  // namespace penumbra::image

#include "image/probe.h"

#include <array>

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

// PNG specification, section 11.2.2: IHDR is the first chunk.
scene::ImageHeader probe_png(std::span<const std::byte> encoded) {
  constexpr std::size_t header_end = 33;
  if (encoded.size() < header_end) fail("PNG ends inside a chunk");
  if (!starts_with(encoded.subspan(12), "IHDR") || big_endian(encoded, 8, 4) != 13)
    fail("PNG does not begin with its header");
  constexpr std::array<int, 7> channels{1, 0, 3, 3, 2, 0, 4};  // by colour type
  const auto color_type = big_endian(encoded, 25, 1);
  if (color_type >= channels.size() || channels[color_type] == 0) fail("PNG with colour type {}", color_type);
  return header_of(big_endian(encoded, 16, 4), big_endian(encoded, 20, 4), channels[color_type]);
}

scene::ImageHeader probe_jpeg(std::span<const std::byte> encoded) {
  JpegSegments segments(encoded);
  for (JpegSegment segment = segments.next(); !segment.bytes.empty(); segment = segments.next()) {
    if (segment.marker == jpeg::start_of_scan) break;
    if (!jpeg::is_frame_header(segment.marker)) continue;
    if (segment.payload.size() < 6) fail("JPEG ends inside its header");
    return header_of(big_endian(segment.payload, 3, 2), big_endian(segment.payload, 1, 2),
                     static_cast<int>(big_endian(segment.payload, 5, 1)));
  }
  fail("JPEG without a header");
}

}  // namespace

void check_pixels(std::int64_t width, std::int64_t height, std::size_t max_pixels) {
  if (static_cast<std::size_t>(height) > max_pixels / static_cast<std::size_t>(width))
    fail("{} x {} pixels, over the limit of {}", width, height, max_pixels);
}

scene::ImageHeader probe(std::span<const std::byte> encoded) {
  if (starts_with(encoded, png_signature)) return probe_png(encoded);
  if (starts_with(encoded, jpeg_signature)) return probe_jpeg(encoded);
  fail("neither PNG nor JPEG");
}

}  // namespace penumbra::image

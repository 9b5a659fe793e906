#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace penumbra::image {

// One segment of a JPEG file (ITU-T T.81, annex B): its marker, and all its bytes with marker and length.
struct JpegSegment {
  std::uint8_t marker = 0;
  std::span<const std::byte> bytes;    // empty if the file ends before another marker
  std::span<const std::byte> payload;  // the bytes after the length; empty for markers without a length
};

// Iterates over a JPEG's segments as decoders do: fill bytes and stray bytes are skipped up to the next marker.
class JpegSegments {
 public:
  explicit JpegSegments(std::span<const std::byte> encoded) : rest_(encoded) {}

  // The next segment. Throws Error if the file ends inside it.
  JpegSegment next();
  // Call after a start-of-scan segment: the compressed data up to the next marker that is not a restart marker.
  std::span<const std::byte> scan_data();

 private:
  std::span<const std::byte> rest_;
};

namespace jpeg {
constexpr std::uint8_t start_of_image = 0xD8, end_of_image = 0xD9, start_of_scan = 0xDA;
constexpr std::uint8_t quantization = 0xDB, huffman = 0xC4, arithmetic = 0xCC, restart_interval = 0xDD;
constexpr std::uint8_t app0 = 0xE0, app14 = 0xEE;

// SOF0 to SOF15: the header of a frame, with its size.
constexpr bool is_frame_header(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != huffman && marker != arithmetic && marker != 0xC8;
}

// TEM, RST0 to RST7, SOI and EOI have no length.
constexpr bool stands_alone(std::uint8_t marker) { return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD9); }
}  // namespace jpeg

}  // namespace penumbra::image

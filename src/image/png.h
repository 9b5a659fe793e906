#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra::image {

// A PNG's stored values: palettes and fewer than 8 bits are expanded, a transparent colour becomes alpha, and gamma and
// profiles are ignored.
struct PngPixels {
  int width = 0, height = 0;
  int channels = 0;        // 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha
  bool is_16_bit = false;  // else values have 8 bits
  std::vector<std::byte>
      values;  // rows top to bottom, channels interleaved, alpha unassociated; 16 bits as std::uint16_t

  std::size_t count() const { return values.size() / (is_16_bit ? 2 : 1); }
  // The value at index `i` of `values`, as 0 to 1.
  float value(std::size_t i) const;
  // The same as 8 bits, rounded.
  std::uint8_t byte(std::size_t i) const;
};

// Decodes a PNG. Uses libpng directly, because through OpenImageIO libpng prints its own messages about faulty files.
// Images of more than `max_pixels` are refused before anything is decoded. Throws Error with the cause.
PngPixels decode_png(std::span<const std::byte> encoded, std::size_t max_pixels);

}  // namespace penumbra::image

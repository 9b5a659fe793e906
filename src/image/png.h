#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace penumbra::image {

// A PNG's values as they are: palettes and fewer than 8 bits are expanded, a transparent colour becomes alpha, and what
// the file says of gamma and profiles is ignored.
struct PngPixels {
  int width = 0, height = 0;
  int channels = 0;        // 1 grey, 2 grey and alpha, 3 colour, 4 colour and alpha
  bool is_16_bit = false;  // else 8 bits a value
  std::vector<std::byte>
      values;  // rows top to bottom, channels interleaved, alpha unassociated; 16 bits as std::uint16_t

  std::size_t count() const { return values.size() / (is_16_bit ? 2 : 1); }
  // Value number `i` as 0 to 1.
  float value(std::size_t i) const;
  // The same in 8 bits, rounded.
  std::uint8_t byte(std::size_t i) const;
};

// Decodes a PNG. With libpng itself, since OpenImageIO leaves it to libpng to print what is wrong with a file. More
// than `max_pixels` are refused before anything is decoded. Throws Error with the cause.
PngPixels decode_png(std::span<const std::byte> encoded, std::size_t max_pixels);

}  // namespace penumbra::image

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace penumbra::metrics {

// A non-owning view of a picture's pixels: rows top to bottom, channels interleaved.
struct ImageView {
  int width = 0, height = 0;
  std::span<const float> pixels;  // width · height · channels values
  int channels = 1;               // 1: visibility or grey, 3: colour

  std::size_t pixel_count() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

// One byte per pixel, rows top to bottom: pixels that are not 0 are measured, the others are ignored. Empty: all pixels
// are measured.
using Receivers = std::span<const std::uint8_t>;

// The error of one value, test − reference. In every metric a test value that is NaN or infinite counts as an error of
// 1: +1 for references up to 0.5, else −1. Sky and other pixels that are no receivers may have any value.
float signed_error(float test, float reference);

// Throws Error if the two differ in size or channels, if `receivers` is neither empty nor one byte a pixel, or if the
// reference is not finite at a receiver.
void check(const ImageView& test, const ImageView& reference, Receivers receivers);

inline bool is_receiver(Receivers receivers, std::size_t pixel) { return receivers.empty() || receivers[pixel] != 0; }

}  // namespace penumbra::metrics

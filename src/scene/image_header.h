#pragma once

#include <cstddef>
#include <functional>
#include <span>

namespace penumbra::scene {

// What an image file says about its size before a pixel is decoded.
struct ImageHeader {
  int width = 0, height = 0;      // pixels, at least 1 each
  int channels = 0;               // in the file: 1 grey, 2 grey and alpha, 3 colour (a palette too), 4
  std::size_t decoded_bytes = 0;  // memory of the decoded image (scene::Image), 8-bit RGBA
};

// Reads the header of an encoded image. Throws Error with the cause.
using ImageProbe = std::function<ImageHeader(std::span<const std::byte> encoded)>;

}  // namespace penumbra::scene

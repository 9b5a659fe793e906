#pragma once

#include <algorithm>
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

// Reads a part of an image file: from `offset` on, until `to` is full or the file ends. Returns the number of bytes.
using ReadAt = std::function<std::size_t(std::size_t offset, std::span<std::byte> to)>;

// For a file in memory, which must outlive the result.
inline ReadAt reader_of(std::span<const std::byte> file) {
  return [file](std::size_t offset, std::span<std::byte> to) {
    const auto part = file.subspan(std::min(offset, file.size()));
    const std::size_t count = std::min(part.size(), to.size());
    std::copy_n(part.begin(), count, to.begin());
    return count;
  };
}

// Reads the header of an encoded image, and as little else as possible. Throws Error with the cause.
using ImageProbe = std::function<ImageHeader(const ReadAt& file)>;

}  // namespace penumbra::scene

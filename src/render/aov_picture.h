#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "render/renderer.h"

namespace penumbra::render {

// Rows top to bottom, channels interleaved.
struct ByteImage {
  int channels = 3;
  std::vector<std::uint8_t> pixels;
};

// Supersampling: each pixel of `reduced` is made of factor × factor of `pixels`, an image `factor` times as large as
// width × height.
std::vector<float> reduced(const std::vector<float>& pixels, int width, int height, int channels, int factor,
                           Reduction reduction);

// A display-referred RGB picture, 8 bits a channel, `factor` times as large as width × height, at its own size. The
// mean of a block is taken of linearised display values: what an eye far away would see, and no firefly outshines a
// block.
ByteImage display_bytes(std::vector<std::uint8_t> rgb, int width, int height, int factor);

// The colour of a label, 0, 1, …, in pictures of AOVs: 8-bit sRGB, eight of them in turn. What is no label, as the -1
// of the sky, is black.
std::array<std::uint8_t, 3> label_color(float label);

// An AOV as a picture to look at: visibility and material as they are; albedo encoded as sRGB; normals and motion about
// middle grey; cascades in colours; depth from near to far as white to black, middle grey the picture's median; all
// else relative to the picture's largest value.
ByteImage aov_bytes(std::string_view name, int channels, const std::vector<float>& pixels);

}  // namespace penumbra::render

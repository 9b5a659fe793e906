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

// Reduces a supersampled image: each result pixel is computed from factor × factor pixels of `pixels`, whose size is
// `factor` times width × height.
std::vector<float> reduced(const std::vector<float>& pixels, int width, int height, int channels, int factor,
                           Reduction reduction);

// Reduces a display-referred RGB picture (8 bits a channel, `factor` times width × height) to width × height. Blocks
// are averaged after decoding sRGB to linear display values, as the eye averages them from afar. Averaging tone-mapped
// values also limits what one firefly adds to a block.
ByteImage display_bytes(std::vector<std::uint8_t> rgb, int width, int height, int factor);

// The colour of a label 0, 1, … in pictures of AOVs: 8-bit sRGB, colours that repeat and that can be told apart without
// seeing red, green or blue as others do. Negative values, as the -1 of the sky, are black.
constexpr int label_color_count = 8;
std::array<std::uint8_t, 3> label_color(float label);

// An AOV as a picture for people: visibility and material unchanged; albedo sRGB-encoded; normals and motion centred at
// middle grey; cascades as label colours; depth from white (near) to black (far), with the median at middle grey;
// everything else scaled by the picture's largest value.
ByteImage aov_bytes(std::string_view name, int channels, const std::vector<float>& pixels);

}  // namespace penumbra::render

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace penumbra::image {

// The values of a picture file, or of one layer of it, as they are stored.
struct Picture {
  int width = 0, height = 0;
  bool display = false;               // PNG: sRGB-encoded, 0 to 1; else EXR: linear, any number, NaN as well
  std::string layer;                  // of an EXR; empty for the channels without a layer's name
  std::vector<std::string> channels;  // without the layer's name: "R", "V"
  std::vector<float> pixels;          // rows top to bottom, channels interleaved
};

// Reads a PNG or an EXR. `layer` chooses those of an EXR's channels that are named "layer.channel"; empty: the channels
// without a layer's name, or the only layer. Where R, G and B are among the channels, only they are read. Alpha is left
// out where it is 1 everywhere; else the picture is refused. So are more than `max_pixels`, before anything is decoded.
// Throws Error with one line that names the file and the cause; for an unknown layer it lists near names.
Picture read_picture(const std::filesystem::path& path, const std::string& layer = {},
                     std::size_t max_pixels = std::size_t{1} << 26);

}  // namespace penumbra::image

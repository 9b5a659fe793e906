#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace penumbra::image {

// A picture file's values as they are, or one layer of it.
struct Picture {
  int width = 0, height = 0;
  bool display = false;               // PNG: sRGB-encoded, 0 to 1; else EXR: linear, any number, NaN as well
  std::string layer;                  // of an EXR; empty for the channels without a layer's name
  std::vector<std::string> channels;  // without the layer's name: "R", "V"
  std::vector<float> pixels;          // rows top to bottom, channels interleaved
};

// Reads a PNG or an EXR. `layer` chooses among an EXR's channels "layer.channel"; empty: those without a layer, or the
// only one that there is. Of R, G, B and others (depth, often) the colour is read. Alpha is dropped where it is 1
// everywhere, and refused else. More than `max_pixels` are refused before anything is decoded. Throws Error with one
// line that names the file and the cause; unknown layers list near names.
Picture read_picture(const std::filesystem::path& path, const std::string& layer = {},
                     std::size_t max_pixels = std::size_t{1} << 26);

}  // namespace penumbra::image

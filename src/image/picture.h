#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace penumbra::image {

// The stored values of a picture file, or of one layer of it.
struct Picture {
  int width = 0, height = 0;
  bool display = false;               // true (PNG): sRGB-encoded, 0 to 1; false (EXR): linear, any value including NaN
  std::string layer;                  // the layer of an EXR; empty for channels without a layer name
  std::vector<std::string> channels;  // names without that of the layer: "R", "V"
  std::vector<float> pixels;          // rows top to bottom, channels interleaved
};

// Reads a PNG or an EXR. `layer` selects those channels of an EXR that are named "layer.channel"; empty: the channels
// without a layer name, or the only layer. Where R, G and B are among the channels, only they are read. Alpha is
// dropped if it is 1 everywhere; otherwise the picture is refused. Pictures of more than `max_pixels` are refused
// before anything is decoded. Throws Error with one line that names the file and the cause; for an unknown layer it
// lists similar names.
Picture read_picture(const std::filesystem::path& path, const std::string& layer = {},
                     std::size_t max_pixels = std::size_t{1} << 26);

}  // namespace penumbra::image

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace penumbra::image {

// What a file says about itself: name and value, in this order.
using Metadata = std::vector<std::pair<std::string, std::string>>;

// Some channels of an EXR. Channels are named "layer.channel", or just "channel" where the layer has no name.
struct Layer {
  std::string name;
  std::vector<std::string> channels;
  std::vector<float> pixels;  // rows top to bottom, channels interleaved
};

// Both write to a temporary and rename, put no time, host or user into the file, and throw Error naming the file.

// 8-bit sRGB: `channels` is 1 (grey), 3 or 4; rows top to bottom.
void write_png(const std::filesystem::path& path, int width, int height, int channels,
               std::span<const std::uint8_t> pixels, const Metadata& metadata = {});
// The bytes of such a file.
std::vector<std::byte> encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels,
                                  const Metadata& metadata = {});
// 32-bit float, linear.
void write_exr(const std::filesystem::path& path, int width, int height, std::span<const Layer> layers,
               const Metadata& metadata = {});

}  // namespace penumbra::image

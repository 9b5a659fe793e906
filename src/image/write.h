#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace penumbra::image {

// Metadata of a file: names and values, in this order.
using Metadata = std::vector<std::pair<std::string, std::string>>;

// Some channels of an EXR. Channels are named "layer.channel", or just "channel" where the layer has no name.
struct Layer {
  std::string name;
  std::vector<std::string> channels;
  std::vector<float> pixels;  // rows top to bottom, channels interleaved
};

// The functions that write a file write a temporary and rename it, store no time, host or user, and throw Error that
// names the file.

// Writes 8-bit sRGB: `channels` is 1 (grey), 3 or 4; rows top to bottom.
void write_png(const std::filesystem::path& path, int width, int height, int channels,
               std::span<const std::uint8_t> pixels, const Metadata& metadata = {});
// The bytes that write_png() writes.
std::vector<std::byte> encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels,
                                  const Metadata& metadata = {});
// The bytes that write_exr() writes.
std::vector<std::byte> encode_exr(int width, int height, std::span<const Layer> layers, const Metadata& metadata = {});
// Writes 32-bit floats, linear.
void write_exr(const std::filesystem::path& path, int width, int height, std::span<const Layer> layers,
               const Metadata& metadata = {});

}  // namespace penumbra::image

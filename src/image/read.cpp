#include "image/read.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/error.h"
#include "image/bytes.h"
#include "image/image_library.h"
#include "image/png.h"
#include "image/precheck.h"
#include "image/probe.h"

namespace penumbra::image {
namespace {

// Converts to RGBA. One or two channels are grey; a missing alpha is opaque. `value(i)` is the value at index i of the
// pixels' channels.
template <class Values>
std::vector<std::uint8_t> to_rgba(std::size_t count, std::size_t channels, const Values& value) {
  std::vector<std::uint8_t> rgba(count * 4, 255);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t in = i * channels;
    for (std::size_t c = 0; c < 3; ++c) rgba[i * 4 + c] = value(channels >= 3 ? in + c : in);
    if (channels % 2 == 0) rgba[i * 4 + 3] = value(in + channels - 1);
  }
  return rgba;
}

scene::Image read_png(std::span<const std::byte> encoded, const std::string& name, std::size_t max_pixels) {
  const PngPixels png = decode_png(encoded, max_pixels);
  const auto channels = static_cast<std::size_t>(png.channels);
  return {.name = name,
          .width = png.width,
          .height = png.height,
          .rgba = to_rgba(png.count() / channels, channels, [&](std::size_t i) { return png.byte(i); })};
}

scene::Image read_jpeg(std::span<const std::byte> encoded, const std::string& name, std::size_t max_pixels) {
  const scene::ImageHeader header = probe(encoded);
  check_pixels(header.width, header.height, max_pixels);
  const std::vector<std::byte> cleaned = pixel_segments_of_jpeg(encoded);
  const std::unique_ptr<ImageInput> input = image_library().open("jpeg", cleaned, name, max_pixels);
  const std::size_t channels = std::min(input->channels.size(), std::size_t{4});
  std::vector<std::uint8_t> pixels(input->pixels() * channels);
  input->read(0, static_cast<int>(channels), pixels.data());
  return {.name = name,
          .width = input->width,
          .height = input->height,
          .rgba = to_rgba(input->pixels(), channels, [&](std::size_t i) { return pixels[i]; })};
}

}  // namespace

scene::Image read_image(std::span<const std::byte> encoded, const std::string& name, std::size_t max_pixels) {
  // Only the formats that glTF allows: the library's other decoders would only add attack surface.
  if (starts_with(encoded, png_signature)) return read_png(encoded, name, max_pixels);
  if (starts_with(encoded, jpeg_signature)) return read_jpeg(encoded, name, max_pixels);
  fail("neither PNG nor JPEG");
}

scene::ImageDecoder image_decoder(const scene::ReadLimits& limits) {
  return {[max_pixels = limits.image_pixels](std::span<const std::byte> encoded, const std::string& name) {
            return read_image(encoded, name, max_pixels);
          },
          [](const scene::ReadAt& file) { return probe(file); }};
}

}  // namespace penumbra::image

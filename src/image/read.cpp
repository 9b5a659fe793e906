#include "image/read.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/error.h"
#include "image/bytes.h"
#include "image/memory_input.h"
#include "image/precheck.h"
#include "image/probe.h"

namespace penumbra::image {
namespace {

// One or two channels are grey; a missing alpha is opaque.
std::vector<uint8_t> to_rgba(std::vector<uint8_t> pixels, std::size_t channels) {
  if (channels == 4) return pixels;
  const std::size_t count = pixels.size() / channels;
  std::vector<uint8_t> rgba(count * 4, 255);
  for (std::size_t i = 0; i < count; ++i) {
    const uint8_t* in = &pixels[i * channels];
    for (std::size_t c = 0; c < 3; ++c) rgba[i * 4 + c] = channels >= 3 ? in[c] : in[0];
    if (channels == 2) rgba[i * 4 + 3] = in[1];
  }
  return rgba;
}

}  // namespace

scene::Image read_image(std::span<const std::byte> encoded, const std::string& name, std::size_t max_pixels) {
  // Only the formats that glTF knows: others that the library could read would only be more code to attack.
  const bool png = starts_with(encoded, png_signature);
  if (!png && !starts_with(encoded, jpeg_signature)) fail("neither PNG nor JPEG");
  const std::vector<std::byte> cleaned = png ? pixel_chunks_of_png(encoded) : pixel_segments_of_jpeg(encoded);
  const scene::ImageHeader header = probe(cleaned);
  check_pixels(header.width, header.height, max_pixels);

  MemoryInput input(png ? "png" : "jpeg", cleaned, name, max_pixels);
  const int channels = std::min(input.spec().nchannels, 4);
  std::vector<uint8_t> pixels(input.pixels() * static_cast<std::size_t>(channels));
  input.read(0, channels, OIIO::TypeDesc::UINT8, pixels.data());
  return {.name = name,
          .width = input.spec().width,
          .height = input.spec().height,
          .rgba = to_rgba(std::move(pixels), static_cast<std::size_t>(channels))};
}

scene::ImageDecoder image_decoder(const scene::ReadLimits& limits) {
  return [max_pixels = limits.image_pixels](std::span<const std::byte> encoded, const std::string& name) {
    return read_image(encoded, name, max_pixels);
  };
}

}  // namespace penumbra::image

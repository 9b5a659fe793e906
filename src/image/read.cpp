#include "image/read.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.h"
#include "image/precheck.h"

namespace penumbra::image {
namespace {

bool starts_with(std::span<const std::byte> bytes, std::string_view signature) {
  return bytes.size() >= signature.size() && std::memcmp(bytes.data(), signature.data(), signature.size()) == 0;
}

// The library's cause, which may be several lines, as one.
std::string cause(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? "damaged" : message;
}

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
  const bool png = starts_with(encoded, "\x89PNG\r\n\x1a\n");
  if (!png && !starts_with(encoded, "\xff\xd8\xff")) fail("neither PNG nor JPEG");
  std::vector<std::byte> cleaned;
  if (png)
    cleaned = pixel_chunks_of_png(encoded);
  else
    check_jpeg_scans(encoded);
  if (png) encoded = cleaned;

  const auto input = OIIO::ImageInput::create(png ? "png" : "jpeg");
  if (!input) fail("no decoder: {}", cause(OIIO::geterror()));
  OIIO::Filesystem::IOMemReader memory(const_cast<std::byte*>(encoded.data()), encoded.size());
  OIIO::ImageSpec request, spec;
  // Textures hold straight alpha; the library would multiply it into the colour.
  request.attribute("oiio:UnassociatedAlpha", 1);
  if (!input->set_ioproxy(&memory) || !input->open(name, spec, request)) fail("{}", cause(input->geterror()));
  if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels < 1) fail("an image without pixels");
  const auto width = static_cast<std::size_t>(spec.width), height = static_cast<std::size_t>(spec.height);
  if (height > max_pixels / width) fail("{} x {} pixels, over the limit of {}", width, height, max_pixels);
  const int channels = std::min(spec.nchannels, 4);
  std::vector<uint8_t> pixels(width * height * static_cast<std::size_t>(channels));
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, pixels.data())) fail("{}", cause(input->geterror()));
  return {.name = name,
          .width = spec.width,
          .height = spec.height,
          .rgba = to_rgba(std::move(pixels), static_cast<std::size_t>(channels))};
}

scene::ImageDecoder image_decoder(const scene::ReadLimits& limits) {
  return [max_pixels = limits.image_pixels](std::span<const std::byte> encoded, const std::string& name) {
    return read_image(encoded, name, max_pixels);
  };
}

}  // namespace penumbra::image

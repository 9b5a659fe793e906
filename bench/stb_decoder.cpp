#include "stb_decoder.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

#include <climits>
#include <memory>

#include "core/error.h"

namespace penumbra {

namespace {

constexpr int rgba = 4;

scene::ImageHeader probe(std::span<const std::byte> encoded) {
  if (encoded.size() > INT_MAX) fail("{} bytes are too many for an image", encoded.size());
  scene::ImageHeader header;
  if (stbi_info_from_memory(reinterpret_cast<const stbi_uc*>(encoded.data()), static_cast<int>(encoded.size()),
                            &header.width, &header.height, &header.channels) == 0)
    fail("neither PNG nor JPEG");
  if (header.width < 1 || header.height < 1) fail("an image without pixels");
  header.decoded_bytes = static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) * rgba;
  return header;
}

scene::Image decoded(std::span<const std::byte> encoded, const std::string& name, std::size_t max_pixels) {
  scene::ImageHeader header = probe(encoded);
  const auto columns = static_cast<std::size_t>(header.width), rows = static_cast<std::size_t>(header.height);
  if (rows > max_pixels / columns)
    fail("{} x {} pixels, over the limit of {}", header.width, header.height, max_pixels);
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(reinterpret_cast<const stbi_uc*>(encoded.data()), static_cast<int>(encoded.size()),
                            &header.width, &header.height, &header.channels, rgba),
      stbi_image_free);
  if (!pixels) fail("{}", stbi_failure_reason());
  return {.name = name,
          .width = header.width,
          .height = header.height,
          .rgba = std::vector<std::uint8_t>(pixels.get(), pixels.get() + columns * rows * rgba)};
}

}  // namespace

scene::ImageDecoder stb_decoder(const scene::ReadLimits& limits) {
  return {[max_pixels = limits.image_pixels](std::span<const std::byte> encoded, const std::string& name) {
            return decoded(encoded, name, max_pixels);
          },
          probe};
}

}  // namespace penumbra

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

// A file that stb_image reads from its beginning.
struct Cursor {
  const scene::ReadAt& file;
  std::size_t offset = 0, count = 0;  // where it reads next, and what it has read
  bool ended = false;

  static constexpr std::size_t most = std::size_t{32} << 20;  // bytes: no header is that far away

  static int read(void* user, char* data, int size) {
    Cursor& at = *static_cast<Cursor*>(user);
    const auto wanted = at.count < most ? static_cast<std::size_t>(size) : 0;
    const std::size_t got = at.file(at.offset, std::as_writable_bytes(std::span(data, wanted)));
    at.offset += got;
    at.count += got;
    at.ended = got < static_cast<std::size_t>(size);
    return static_cast<int>(got);
  }
  static void skip(void* user, int size) {
    Cursor& at = *static_cast<Cursor*>(user);
    at.offset = static_cast<std::size_t>(static_cast<std::ptrdiff_t>(at.offset) + size);
  }
  static int eof(void* user) { return static_cast<Cursor*>(user)->ended ? 1 : 0; }
};

scene::ImageHeader probe(const scene::ReadAt& file) {
  constexpr stbi_io_callbacks callbacks{.read = Cursor::read, .skip = Cursor::skip, .eof = Cursor::eof};
  Cursor cursor{file};
  scene::ImageHeader header;
  if (stbi_info_from_callbacks(&callbacks, &cursor, &header.width, &header.height, &header.channels) == 0)
    fail("neither PNG nor JPEG");
  if (header.width < 1 || header.height < 1) fail("an image without pixels");
  header.decoded_bytes = static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height) * rgba;
  return header;
}

scene::Image decoded(std::span<const std::byte> encoded, const std::string& name, std::size_t max_pixels) {
  if (encoded.size() > INT_MAX) fail("{} bytes are too many for an image", encoded.size());
  scene::ImageHeader header = probe(scene::reader_of(encoded));
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

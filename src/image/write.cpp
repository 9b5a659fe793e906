#include "image/write.h"

#include "core/error.h"
#include "image/image_library.h"
#include "io/output_file.h"

namespace penumbra::image {

namespace {

// Encodes to memory first, so that a full disk is found by what writes files.
template <class Encode>
void write(const std::filesystem::path& path, const Encode& encode) {
  std::vector<std::byte> bytes;
  try {
    bytes = encode();
  } catch (const Error& error) {
    fail("cannot write {}: {}", io::quoted(path), error.what());
  }
  io::write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

void write_png(const std::filesystem::path& path, int width, int height, int channels,
               std::span<const std::uint8_t> pixels, const Metadata& metadata) {
  write(path, [&] { return encode_png(width, height, channels, pixels, metadata); });
}

std::vector<std::byte> encode_exr(int width, int height, std::span<const Layer> layers, const Metadata& metadata) {
  return image_library().encode_exr("picture.exr", width, height, layers, metadata);
}

void write_exr(const std::filesystem::path& path, int width, int height, std::span<const Layer> layers,
               const Metadata& metadata) {
  write(path, [&] { return encode_exr(width, height, layers, metadata); });
}

}  // namespace penumbra::image

#include "image/write.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cassert>
#include <memory>

#include "core/error.h"
#include "io/output_file.h"

namespace penumbra::image {

namespace {

OIIO::ImageSpec image_spec(int width, int height, int channels, const OIIO::TypeDesc& type, const Metadata& metadata) {
  OIIO::ImageSpec spec(width, height, channels, type);
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  return spec;
}

// Encodes to memory first, because OpenImageIO doesn't report a full disk.
std::vector<std::byte> encode(const std::string& name, const char* format, const OIIO::ImageSpec& spec,
                              const void* pixels) {
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) fail("cannot write '{}': this OpenImageIO has no {} support", name, format);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const bool encoded = output->set_ioproxy(&memory) && output->open(name, spec) &&
                       output->write_image(spec.format, pixels) && output->close();
  if (!encoded) fail("cannot write '{}': {}", name, output->geterror());
  const std::span<const std::byte> view = std::as_bytes(std::span(bytes));
  return {view.begin(), view.end()};
}

void write(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  io::write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

std::vector<std::byte> png_bytes(const std::string& name, int width, int height, int channels,
                                 std::span<const std::uint8_t> pixels, const Metadata& metadata) {
  assert(pixels.size() == static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels));
  OIIO::ImageSpec spec = image_spec(width, height, channels, OIIO::TypeDesc::UINT8, metadata);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("png:compressionLevel", 4);    // takes a third of the default's time for 5 % more bytes
  spec.attribute("oiio:UnassociatedAlpha", 1);  // the values are written unchanged
  return encode(name, "png", spec, pixels.data());
}

}  // namespace

std::vector<std::byte> encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels,
                                  const Metadata& metadata) {
  return png_bytes("picture.png", width, height, channels, pixels, metadata);
}

void write_png(const std::filesystem::path& path, int width, int height, int channels,
               std::span<const std::uint8_t> pixels, const Metadata& metadata) {
  write(path, png_bytes(path.string(), width, height, channels, pixels, metadata));
}

void write_exr(const std::filesystem::path& path, int width, int height, std::span<const Layer> layers,
               const Metadata& metadata) {
  const size_t pixel_count = static_cast<size_t>(width) * static_cast<size_t>(height);
  size_t channels = 0;
  for (const Layer& layer : layers) channels += layer.channels.size();
  OIIO::ImageSpec spec = image_spec(width, height, static_cast<int>(channels), OIIO::TypeDesc::FLOAT, metadata);
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // otherwise OpenImageIO writes the present time

  spec.channelnames.clear();
  std::vector<float> pixels(pixel_count * channels);
  for (size_t first = 0; const Layer& layer : layers) {
    const size_t count = layer.channels.size();
    assert(layer.pixels.size() == pixel_count * count);
    for (const std::string& channel : layer.channels)
      spec.channelnames.push_back(layer.name.empty() ? channel : layer.name + "." + channel);
    for (size_t i = 0; i < pixel_count; ++i)
      for (size_t c = 0; c < count; ++c) pixels[i * channels + first + c] = layer.pixels[i * count + c];
    first += count;
  }
  write(path, encode(path.string(), "openexr", spec, pixels.data()));
}

}  // namespace penumbra::image

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

// By way of memory: OpenImageIO doesn't notice when a disk is full.
void write(const std::filesystem::path& path, const char* format, const OIIO::ImageSpec& spec, const void* pixels) {
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) fail("cannot write {}: this OpenImageIO has no {} support", io::quoted(path), format);
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const bool encoded = output->set_ioproxy(&memory) && output->open(path.string(), spec) &&
                       output->write_image(spec.format, pixels) && output->close();
  if (!encoded) fail("cannot write {}: {}", io::quoted(path), output->geterror());
  io::write_text(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

void write_png(const std::filesystem::path& path, int width, int height, int channels,
               std::span<const std::uint8_t> pixels, const Metadata& metadata) {
  assert(pixels.size() == static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(channels));
  OIIO::ImageSpec spec = image_spec(width, height, channels, OIIO::TypeDesc::UINT8, metadata);
  spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("png:compressionLevel", 4);    // a third of the default's time for 5 % more bytes
  spec.attribute("oiio:UnassociatedAlpha", 1);  // the bytes go out as they are
  write(path, "png", spec, pixels.data());
}

void write_exr(const std::filesystem::path& path, int width, int height, std::span<const Layer> layers,
               const Metadata& metadata) {
  const size_t pixel_count = static_cast<size_t>(width) * static_cast<size_t>(height);
  size_t channels = 0;
  for (const Layer& layer : layers) channels += layer.channels.size();
  OIIO::ImageSpec spec = image_spec(width, height, static_cast<int>(channels), OIIO::TypeDesc::FLOAT, metadata);
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // without it OpenImageIO writes the present time

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
  write(path, "openexr", spec, pixels.data());
}

}  // namespace penumbra::image

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cassert>

#include "core/error.h"
#include "image/image_library.h"

namespace penumbra::image {

namespace {

// An error message of the library, which may have several lines, as one line.
std::string cause(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? "damaged" : message;
}

class MemoryInput : public ImageInput {
 public:
  MemoryInput(const char* format, std::span<const std::byte> bytes, const std::string& name, std::size_t max_pixels)
      : memory_(const_cast<std::byte*>(bytes.data()), bytes.size()), input_(OIIO::ImageInput::create(format)) {
    if (!input_) fail("no decoder: {}", cause(OIIO::geterror()));
    OIIO::ImageSpec spec, request;
    request.attribute("oiio:UnassociatedAlpha", 1);  // otherwise the library multiplies colour by alpha
    if (!input_->set_ioproxy(&memory_) || !input_->open(name, spec, request)) fail("{}", cause(input_->geterror()));
    if (spec.width <= 0 || spec.height <= 0 || spec.depth > 1 || spec.nchannels < 1) fail("an image without pixels");
    width = spec.width;
    height = spec.height;
    channels = spec.channelnames;
    if (pixels() > max_pixels) fail("{} x {} pixels, over the limit of {}", width, height, max_pixels);
  }

  void read(int first, int end, float* values) override { read(first, end, OIIO::TypeDesc::FLOAT, values); }
  void read(int first, int end, std::uint8_t* values) override { read(first, end, OIIO::TypeDesc::UINT8, values); }

 private:
  void read(int first, int end, const OIIO::TypeDesc& type, void* values) {
    if (!input_->read_image(0, 0, first, end, type, values)) fail("{}", cause(input_->geterror()));
  }

  OIIO::Filesystem::IOMemReader memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
};

OIIO::ImageSpec exr_spec(int width, int height, std::span<const Layer> layers, const Metadata& metadata) {
  std::vector<std::string> names;
  for (const Layer& layer : layers) {
    for (const std::string& channel : layer.channels)
      names.push_back(layer.name.empty() ? channel : layer.name + "." + channel);
  }
  OIIO::ImageSpec spec(width, height, static_cast<int>(names.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = std::move(names);
  for (const auto& [name, value] : metadata) spec.attribute(name, value);
  spec.attribute("oiio:ColorSpace", "Linear");
  spec.attribute("compression", "zip");
  spec.attribute("DateTime", "");  // otherwise OpenImageIO writes the present time
  return spec;
}

class OpenImageIo : public ImageLibrary {
 public:
  std::unique_ptr<ImageInput> open(const char* format, std::span<const std::byte> bytes, const std::string& name,
                                   std::size_t max_pixels) const override {
    return std::make_unique<MemoryInput>(format, bytes, name, max_pixels);
  }

  // Encodes to memory, because OpenImageIO doesn't report a full disk.
  std::vector<std::byte> encode_exr(const std::string& name, int width, int height, std::span<const Layer> layers,
                                    const Metadata& metadata) const override {
    const OIIO::ImageSpec spec = exr_spec(width, height, layers, metadata);
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<float> pixels(count * channels);
    for (std::size_t first = 0; const Layer& layer : layers) {
      const std::size_t own = layer.channels.size();
      assert(layer.pixels.size() == count * own);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < own; ++c) pixels[i * channels + first + c] = layer.pixels[i * own + c];
      first += own;
    }
    const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create("openexr");
    if (!output) fail("this OpenImageIO has no EXR support");
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const bool encoded = output->set_ioproxy(&memory) && output->open(name, spec) &&
                         output->write_image(spec.format, pixels.data()) && output->close();
    if (!encoded) fail("{}", cause(output->geterror()));
    const std::span<const std::byte> view = std::as_bytes(std::span(bytes));
    return {view.begin(), view.end()};
  }
};

}  // namespace

}  // namespace penumbra::image

// What image_library() looks for.
extern "C" const penumbra::image::ImageLibrary* penumbra_image_library();
const penumbra::image::ImageLibrary* penumbra_image_library() {
  static const penumbra::image::OpenImageIo library;
  return &library;
}

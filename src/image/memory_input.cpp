#include "image/memory_input.h"

#include <algorithm>

#include "core/error.h"
#include "image/precheck.h"

namespace penumbra::image {

std::string cause(std::string message) {
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? "damaged" : message;
}

MemoryInput::MemoryInput(const char* format, std::span<const std::byte> bytes, const std::string& name,
                         std::size_t max_pixels)
    : memory_(const_cast<std::byte*>(bytes.data()), bytes.size()), input_(OIIO::ImageInput::create(format)) {
  if (!input_) fail("no decoder: {}", cause(OIIO::geterror()));
  OIIO::ImageSpec request;
  request.attribute("oiio:UnassociatedAlpha", 1);  // otherwise the library multiplies colour by alpha
  if (!input_->set_ioproxy(&memory_) || !input_->open(name, spec_, request)) fail("{}", cause(input_->geterror()));
  if (spec_.width <= 0 || spec_.height <= 0 || spec_.depth > 1 || spec_.nchannels < 1) fail("an image without pixels");
  check_pixels(spec_.width, spec_.height, max_pixels);
}

std::size_t MemoryInput::pixels() const {
  return static_cast<std::size_t>(spec_.width) * static_cast<std::size_t>(spec_.height);
}

void MemoryInput::read(int first, int end, const OIIO::TypeDesc& type, void* pixels) {
  if (!input_->read_image(0, 0, first, end, type, pixels)) fail("{}", cause(input_->geterror()));
}

}  // namespace penumbra::image

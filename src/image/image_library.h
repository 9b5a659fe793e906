#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "image/write.h"

namespace penumbra::image {

// An image file in memory. Alpha stays unassociated. Functions throw Error with the cause.
class ImageInput {
 public:
  virtual ~ImageInput() = default;

  // Reads channels `first` to `end` (exclusive), interleaved, rows top to bottom.
  virtual void read(int first, int end, float* values) = 0;
  virtual void read(int first, int end, std::uint8_t* values) = 0;

  std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }

  int width = 0, height = 0;
  std::vector<std::string> channels;
};

// All that Penumbra does with OpenImageIO: JPEG and EXR. It is a module, which is loaded when it is first asked for:
// OpenImageIO brings 266 libraries, and binding them takes longer than most commands.
class ImageLibrary {
 public:
  virtual ~ImageLibrary() = default;

  // `format` is OpenImageIO's name of it; `bytes` must outlive the result. Images of more than `max_pixels` are refused
  // before anything is decoded.
  virtual std::unique_ptr<ImageInput> open(const char* format, std::span<const std::byte> bytes,
                                           const std::string& name, std::size_t max_pixels) const = 0;
  // The bytes of an EXR of 32-bit floats; `name` is for messages.
  virtual std::vector<std::byte> encode_exr(const std::string& name, int width, int height,
                                            std::span<const Layer> layers, const Metadata& metadata) const = 0;
};

// Throws Error if the module is missing or can't be loaded.
const ImageLibrary& image_library();

}  // namespace penumbra::image

#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace penumbra::image {

// An error message of the library, which may have several lines, as one line.
std::string cause(std::string message);

// An image file in memory that OpenImageIO reads. Alpha stays unassociated. Throws Error with the cause.
class MemoryInput {
 public:
  // `format` is OpenImageIO's name of it; `bytes` must outlive this object.
  MemoryInput(const char* format, std::span<const std::byte> bytes, const std::string& name, std::size_t max_pixels);

  const OIIO::ImageSpec& spec() const { return spec_; }
  std::size_t pixels() const;
  // Reads channels `first` to `end` (exclusive), interleaved, rows top to bottom.
  void read(int first, int end, const OIIO::TypeDesc& type, void* pixels);

 private:
  OIIO::Filesystem::IOMemReader memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
};

}  // namespace penumbra::image

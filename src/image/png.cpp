#include "image/png.h"

#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>
#include <string>

#include "core/error.h"
#include "image/precheck.h"
#include "image/probe.h"

namespace penumbra::image {
namespace {

// What libpng's callbacks read from.
struct Source {
  std::span<const std::byte> rest;
  std::string fault;
};

[[noreturn]] void keep_fault(png_structp png, png_const_charp message) {
  static_cast<Source*>(png_get_error_ptr(png))->fault = message;
  png_longjmp(png, 1);
}

// Warnings are ignored: the file can still be read.
void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

void read_bytes(png_structp png, png_bytep to, std::size_t count) {
  auto& rest = static_cast<Source*>(png_get_io_ptr(png))->rest;
  if (count > rest.size()) png_error(png, "the file ends early");
  std::memcpy(to, rest.data(), count);
  rest = rest.subspan(count);
}

// RAII wrapper of libpng's reader. libpng reports errors by longjmp, which runs no destructors, so functions here that
// call libpng have no local objects with destructors during the call.
class Reader {
 public:
  explicit Reader(std::span<const std::byte> encoded) : source_{encoded, {}} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, keep_fault, ignore_warning);
    info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &source_, read_bytes);
  }
  ~Reader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  PngPixels read() {
    if (!read_header()) fail("{}", source_.fault);
    PngPixels pixels{.width = static_cast<int>(png_get_image_width(png_, info_)),
                     .height = static_cast<int>(png_get_image_height(png_, info_)),
                     .channels = png_get_channels(png_, info_),
                     .is_16_bit = png_get_bit_depth(png_, info_) == 16,
                     .values = {}};
    const std::size_t row_bytes = png_get_rowbytes(png_, info_), height = static_cast<std::size_t>(pixels.height);
    pixels.values.resize(row_bytes * height);
    std::vector<png_bytep> rows(height);
    for (std::size_t y = 0; y < height; ++y)
      rows[y] = reinterpret_cast<png_bytep>(pixels.values.data()) + y * row_bytes;
    if (!read_rows(rows.data())) fail("{}", source_.fault);
    return pixels;
  }

 private:
  bool read_header() {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT(cert-err52-cpp): libpng has no other error handling
    png_read_info(png_, info_);
    png_set_expand(png_);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    return true;
  }

  bool read_rows(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT(cert-err52-cpp)
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  Source source_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

std::uint16_t value_16(const PngPixels& pixels, std::size_t i) {
  std::uint16_t value = 0;
  std::memcpy(&value, pixels.values.data() + 2 * i, sizeof value);
  return value;
}

}  // namespace

float PngPixels::value(std::size_t i) const {
  if (is_16_bit) return static_cast<float>(value_16(*this, i)) * (1.0f / 65535.0f);
  return static_cast<float>(std::to_integer<std::uint8_t>(values[i])) * (1.0f / 255.0f);
}

std::uint8_t PngPixels::byte(std::size_t i) const {
  if (is_16_bit) return static_cast<std::uint8_t>((value_16(*this, i) + 128) / 257);  // 65535 is 255 times 257
  return std::to_integer<std::uint8_t>(values[i]);
}

PngPixels decode_png(std::span<const std::byte> encoded, std::size_t max_pixels) {
  const std::vector<std::byte> chunks = pixel_chunks_of_png(encoded);
  const scene::ImageHeader header = probe(chunks);
  check_pixels(header.width, header.height, max_pixels);
  return Reader(chunks).read();
}

}  // namespace penumbra::image

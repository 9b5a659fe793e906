#include "image/packed.h"

#include <zlib.h>

#include <cstring>

#include "core/error.h"

namespace penumbra::image {

std::vector<std::byte> pack_floats(std::span<const float> values) {
  const std::size_t count = values.size();
  std::vector<std::byte> planes(count * sizeof(float));
  for (std::size_t i = 0; i < count; ++i) {
    std::byte bytes[sizeof(float)];
    std::memcpy(bytes, &values[i], sizeof(float));
    for (std::size_t plane = 0; plane < sizeof(float); ++plane) planes[plane * count + i] = bytes[plane];
  }
  uLongf size = compressBound(planes.size());
  std::vector<std::byte> packed(size);
  if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(planes.data()),
                planes.size(), Z_BEST_SPEED) != Z_OK)
    fail("zlib can't pack {} floats", count);
  packed.resize(size);
  return packed;
}

std::vector<float> unpack_floats(std::span<const std::byte> packed, std::size_t count) {
  std::vector<std::byte> planes(count * sizeof(float));
  uLongf size = planes.size();
  const int result = uncompress(reinterpret_cast<Bytef*>(planes.data()), &size,
                                reinterpret_cast<const Bytef*>(packed.data()), packed.size());
  if (result != Z_OK || size != planes.size()) fail("these are not {} packed floats", count);
  std::vector<float> values(count);
  for (std::size_t i = 0; i < count; ++i) {
    std::byte bytes[sizeof(float)];
    for (std::size_t plane = 0; plane < sizeof(float); ++plane) bytes[plane] = planes[plane * count + i];
    std::memcpy(&values[i], bytes, sizeof(float));
  }
  return values;
}

}  // namespace penumbra::image

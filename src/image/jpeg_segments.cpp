#include "image/jpeg_segments.h"

#include <algorithm>

#include "core/error.h"
#include "image/bytes.h"

namespace penumbra::image {
namespace {

constexpr std::byte marker_prefix{0xFF}, stuffing{0x00};

bool is_restart(std::byte marker) { return marker >= std::byte{0xD0} && marker <= std::byte{0xD7}; }

}  // namespace

JpegSegment JpegSegments::next() {
  while (rest_.size() >= 2) {
    const bool found = rest_[0] == marker_prefix && rest_[1] != marker_prefix && rest_[1] != stuffing;
    if (found) break;
    rest_ = rest_.subspan(1);
  }
  if (rest_.size() < 2) return {};
  const auto marker = std::to_integer<std::uint8_t>(rest_[1]);
  std::size_t size = 2;
  if (!jpeg::stands_alone(marker)) {
    if (rest_.size() < 4) fail("JPEG ends inside a segment");
    size += big_endian(rest_, 2, 2);
    if (size < 4) fail("JPEG has a segment of a wrong length");
    if (size > rest_.size()) fail("JPEG ends inside a segment");
  }
  const auto bytes = rest_.first(size);
  rest_ = rest_.subspan(size);
  return {marker, bytes, bytes.subspan(std::min<std::size_t>(size, 4))};
}

std::span<const std::byte> JpegSegments::scan_data() {
  std::size_t end = 0;
  while (end + 1 < rest_.size()) {
    const std::byte second = rest_[end + 1];
    if (rest_[end] == marker_prefix && second != stuffing && second != marker_prefix && !is_restart(second)) break;
    ++end;
  }
  if (end + 1 >= rest_.size()) end = rest_.size();
  const auto data = rest_.first(end);
  rest_ = rest_.subspan(end);
  return data;
}

}  // namespace penumbra::image

#pragma once

#include <cstddef>

#include "api.h"

namespace penumbra::gl {

// How a format's channels are read and cleared; `real` has floating-point and normalised formats.
enum class ChannelKind { real, signed_integer, unsigned_integer, depth, depth_stencil };

struct FormatInfo {
  std::size_t bytes;  // a texel
  ChannelKind kind;
};

// Throws Error for a format that Penumbra does not use.
FormatInfo format_info(GLenum sized_format);

// Bytes of one pixel of client memory in `format`/`type`; throws Error for a pair that Penumbra does not use.
std::size_t pixel_bytes(GLenum format, GLenum type);

}  // namespace penumbra::gl

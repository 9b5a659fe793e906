#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace penumbra::image {

// Floats without loss in fewer bytes: zlib's format (RFC 1950) of their bytes, all lowest bytes first, then all second
// ones and so on, because those of neighbours are alike. Equal floats give equal bytes.
std::vector<std::byte> pack_floats(std::span<const float> values);

// The `count` floats that were packed. Throws Error unless `packed` is exactly that.
std::vector<float> unpack_floats(std::span<const std::byte> packed, std::size_t count);

}  // namespace penumbra::image

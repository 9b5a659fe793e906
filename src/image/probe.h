#pragma once

#include <cstddef>
#include <span>

#include "scene/image_header.h"

namespace penumbra::image {

// Size and channels of a PNG or JPEG from its header alone, without decoding or allocating anything. Only the bytes up
// to the header (PNG: IHDR; JPEG: the first SOF segment) are read, so damage after it is not found. Throws Error with
// the cause for other formats, a header that is truncated or wrong, and an image without pixels. The scene reader uses
// it as its ImageProbe.
scene::ImageHeader probe(std::span<const std::byte> encoded);

}  // namespace penumbra::image

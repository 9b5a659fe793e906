#pragma once

#include <cstddef>
#include <span>

#include "scene/image_header.h"

namespace penumbra::image {

// Size and channels of a PNG or JPEG from its header alone: nothing is decoded, and nothing is allocated. Only the
// bytes up to the header (PNG: IHDR; JPEG: the first SOF segment) are looked at, so damage behind it is not found.
// Throws Error with the cause for other formats, a header that is cut or wrong, and an image without pixels. As an
// ImageProbe it goes to the scene reader.
scene::ImageHeader probe(std::span<const std::byte> encoded);

}  // namespace penumbra::image

#pragma once

#include <cstddef>
#include <span>

#include "scene/image_header.h"

namespace penumbra::image {

// Size and channels of a PNG or JPEG from its header alone, without decoding or allocating anything. Nothing behind the
// header (PNG: IHDR; JPEG: the first SOF segment) is read, so damage after it is not found, and the contents of a
// JPEG's segments before it are skipped. At most 32 MiB are read. Throws Error with the cause for other formats, a
// header that is truncated or wrong, and an image without pixels. The scene reader uses it as its ImageProbe.
scene::ImageHeader probe(const scene::ReadAt& file);
// The same for a file in memory.
scene::ImageHeader probe(std::span<const std::byte> encoded);

}  // namespace penumbra::image

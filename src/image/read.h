#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "scene/gltf.h"
#include "scene/scene.h"

namespace penumbra::image {

// Decodes a PNG or JPEG file in memory to 8-bit RGBA. Alpha stays unassociated, 16-bit channels are reduced to 8 bits,
// and the colour space that the file declares is ignored, as glTF requires. Throws Error with the cause. Images of more
// than `max_pixels` are refused before they are decoded.
scene::Image read_image(std::span<const std::byte> encoded, const std::string& name, std::size_t max_pixels);

// The decoder that read_gltf takes.
scene::ImageDecoder image_decoder(const scene::ReadLimits& limits = {});

}  // namespace penumbra::image

#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "scene/gltf.h"
#include "scene/scene.h"

namespace penumbra::image {

// A PNG or JPEG file in memory as 8-bit RGBA. Alpha stays unassociated, 16-bit channels are reduced, and the colour
// space that the file may declare is ignored, as glTF demands. Throws Error with the cause. More than `max_pixels` are
// refused before they are decoded.
scene::Image read_image(std::span<const std::byte> encoded, const std::string& name, std::size_t max_pixels);

// The decoder that read_gltf takes.
scene::ImageDecoder image_decoder(const scene::ReadLimits& limits = {});

}  // namespace penumbra::image

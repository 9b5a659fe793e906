#pragma once

#include "scene/gltf.h"

namespace penumbra {

// Decodes PNG and JPEG by stb_image, where there is no OpenImageIO. Like image::image_decoder() it ignores declared
// colour spaces and reduces 16-bit channels; it knows fewer of JPEG's forms.
scene::ImageDecoder stb_decoder(const scene::ReadLimits& limits = {});

}  // namespace penumbra

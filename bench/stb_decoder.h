#pragma once

#include "scene/gltf.h"

namespace penumbra {

// Decodes PNG and JPEG with stb_image, for builds without OpenImageIO. Like image::image_decoder() it ignores declared
// colour spaces and reduces 16-bit channels to 8 bits; it supports fewer variants of JPEG.
scene::ImageDecoder stb_decoder(const scene::ReadLimits& limits = {});

}  // namespace penumbra

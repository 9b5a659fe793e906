#pragma once

#include <vector>

#include "gl/shader_source.h"
#include "gl/texture.h"
#include "shadow/registry.h"

namespace penumbra::test {

// A technique that uses every part of the contract: a product, named samples, a denoiser of its own, a stencil pass, an
// indirect dispatch, and the casters' triangles. It projects casters onto the ground as triangles, marks what they
// cover in the stencil (planar shadows, Blinn 1988), and blurs the edge over a disc of a constant number of pixels.

constexpr int planar_blur_radius = 12;  // by default, pixels

// What the passes have done since the test last changed it.
struct PlanarRecord {
  int builds = 0;                            // of the recipe
  std::vector<const gl::Texture*> filtered;  // by filters_twice: the source, and what each filter filled
};
PlanarRecord& planar_record();

// Techniques "planar", "planar_read" (which reads the product, but no shadow map, and has no passes), "none" and
// "pcss"; denoisers "averaging" and "filters_twice"; the recipe "blur_radius".
shadow::Registry with_planar();

// The files that their programs are compiled from.
void put_planar_shaders(gl::ShaderFiles& files);

}  // namespace penumbra::test

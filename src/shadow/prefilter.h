#pragma once

#include <functional>
#include <string>
#include <vector>

#include "recipe.h"

namespace penumbra::shadow {

// A filtered map: an array of 2D textures that holds, in one or more slices for each layer of a light's shadow map, the
// mean of functions of the stored depth (0 to 1) over a kernel of constant radius in metres, and over wider ones in its
// coarser levels. Readers fetch texels and interpolate these themselves (glsl/shadow/prefiltered.glsl).
//
// Filtering depends on the function alone, so that all such products have the same passes: the mean over blocks of the
// map's texels, a separable Gaussian whose standard deviation is half the radius and which ends at the radius, and a
// chain of levels. Each layer is filtered at the level at which the radius is 4 to 8 texels (kernel_level() in
// glsl/lib/prefilter.glsl), or level 0 if it is smaller there; nothing may read its finer levels, which are not
// filtered, or not filled at all. Where texels are smaller for nearer receivers (LightProjection::texels_vary()), that
// is the level at the largest texels, and each coarser one holds the same function with a kernel twice as wide. A
// texture's side is a power of two: texels beyond the shadow map are those of an empty map.
struct FilteredMap {
  std::string name;    // of the recipe
  std::string prefix;  // of its parameters, PREFIX.radius and PREFIX.shrink
  std::string summary;
  std::string source;
  // GLSL file that defines `vec4 of_depth(float depth, int slice)` and then includes shadow/prefilter/from_depth.glsl.
  std::string function;
  std::function<GLenum(const ParamSet&)> format;
  // Of each layer of the shadow map; absent: 1.
  std::function<int(const ParamSet&)> slices = {};
  // Besides radius and shrink.
  std::vector<Param> params = {};
  // The means are those of exponentials: see glsl/shadow/prefilter/mean.glsl.
  bool log_space = false;
  float radius = 0.05f;  // default, metres; 0: there is no such parameter, and level 0 is not filtered
};

Recipe filtered_map(const FilteredMap& map);

}  // namespace penumbra::shadow

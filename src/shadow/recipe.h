#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "../core/params.h"
#include "../gl/program.h"
#include "../gl/texture.h"

namespace penumbra::shadow {

class PassContext;

// How a product is made: a texture that follows from a light's maps (a pyramid, moments, a summed-area table), or from
// its casters and receivers. Techniques, denoisers and other recipes ask for it by name; it is made once a light and
// frame for all that ask, and not at all where none does. Their GLSL declares it at a unit that the library defines:
//   layout(binding = UNIT_least_depth_pyramid) uniform sampler2DArray shadow_pyramid;
struct Recipe {
  std::string name;     // an identifier of GLSL, lower case
  std::string summary;  // one sentence: what the texture holds
  std::string source;   // "Author Year, section"
  // What it is made of, by name: "shadow_map", and recipes that come before it in the registry.
  std::vector<std::string> needs = {"shadow_map"};
  std::vector<Param> params = {};
  gl::SamplerDesc sampler = {};  // how those that asked read it
  // Makes it in passes of its own. The texture, as PassContext::target() gives it, stays as it is until the next frame.
  std::function<const gl::Texture&(const PassContext&)> build;
  // The programs that `build` uses under these parameters, by name, as Technique::programs.
  std::function<std::vector<gl::ProgramDesc>(const ParamSet&)> programs = {};
};

// The maps that the library itself draws with the caller's casters, which have units of their own: "shadow_map", and
// "movement_map" for denoisers.
bool is_base_map(std::string_view name);

}  // namespace penumbra::shadow

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

// How to make a product: a texture derived from a light's shadow map (a pyramid, moments, a summed-area table), or from
// its casters and receivers. Techniques, denoisers and other recipes list it in their `needs` by name. It is made once
// for each light and frame, however many need it, and not at all if none does or it would be the same as in the last
// frame. Their GLSL declares it at a texture unit that the library defines:
//   layout(binding = UNIT_least_depth_pyramid) uniform sampler2DArray shadow_pyramid;
struct Recipe {
  std::string name;     // an identifier of GLSL, lower case
  std::string summary;  // one sentence: what the texture holds
  std::string source;   // "Author Year, section"
  // The textures that it is made from, by name: "shadow_map", and recipes that come before it in the registry.
  std::vector<std::string> needs = {"shadow_map"};
  // Those that are compiled are constants in the programs of all that need the recipe.
  std::vector<Param> params = {};
  // With which its readers sample it. Without mip levels in the filter, only level 0 may be fetched (OpenGL 4.5,
  // section 11.1.3.2).
  gl::SamplerDesc sampler = {.min_filter = GL_NEAREST_MIPMAP_NEAREST};
  // Whether the texture depends on nothing but its `needs`, its `params`, and the light's projection and shape: not on
  // receivers, the view, casters, other parameters or the number of the frame. It is then not made again as long as
  // these are the same (parameter maps.keep).
  bool depends_only_on_needs = false;
  // Whether what receivers read of it depends on the maps only as Technique::reads_light_discs says.
  bool reads_light_discs = false;
  // Whether its passes test depths against the shadow map itself, which must then have a depth format.
  bool tests_depths = false;
  // Whether it is made with these parameters; absent: always. If not, its unit has no texture, and GLSL that needs it
  // must not read it; which it knows from the recipe's compiled parameters.
  std::function<bool(const ParamSet&)> applies = {};
  // Makes it by its own passes, and returns the texture, which it gets from PassContext::target() and which nothing may
  // change until it is made again.
  std::function<const gl::Texture&(const PassContext&)> build;
  // The programs that `build` uses with these parameters, by name, like Technique::programs.
  std::function<std::vector<gl::ProgramDesc>(const ParamSet&)> programs = {};
};

// Whether the name is one of the maps that the library itself draws with the caller's casters, and binds to fixed
// texture units: "shadow_map", and "movement_map" for denoisers.
bool is_base_map(std::string_view name);

}  // namespace penumbra::shadow

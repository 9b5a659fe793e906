#include "library_params.h"

#include "cascades.h"
#include "sampling.h"

namespace penumbra::shadow {

namespace {

Param pattern(const char* name, const char* help) {
  return {name, std::string("vogel"), 0, 0, "", help, ParamBinding::host, pattern_names()};
}

Param sequence(const char* name, const char* help) {
  return {name, std::string("still"), 0, 0, "", help, ParamBinding::host, {"still", "shift", "set"}};
}

}  // namespace

std::vector<Param> library_params() {
  using enum ParamBinding;
  return {
      {"driver",
       std::string("fragment"),
       0,
       0,
       "",
       "Shader stage that evaluates the technique.",
       host,
       {"fragment", "compute"}},
      {"sun.angle", 0.53f, 0, 20, "deg", "Full angle that the sun spans as seen from the ground.", host},
      {"sun.shape",
       std::string("disc"),
       0,
       0,
       "",
       "Outline of the sun: a disc, or a square with two horizontal sides.",
       host,
       {"disc", "square"}},
      {"cascades.count", 4, 1, max_cascades, "", "Cascades of the sun's shadow map.", host},
      {"cascades.size", 2048, 16, 8192, "texels", "Side of each cascade's map.", host},
      {"cascades.split", 0.75f, 0, 1, "", "Spacing of the cascades: 0 uniform, 1 logarithmic.", host},
      {"cascades.distance", 0.0f, 0, 1e7, "m", "Range of the last cascade; 0 takes what the view sees of the scene.",
       host},
      {"cascades.seam",
       std::string("fade"),
       0,
       0,
       "",
       "Transition between cascades.",
       uniform,
       {"none", "fade", "dither"}},
      {"cascades.blend", 0.1f, 0.001, 0.5, "", "Width of the transition, as a part of the cascade's half width."},
      {"bias.constant", 0.02f, 0, 10, "texels",
       "Distance along the light that a texel may lie before a receiver without blocking it."},
      {"bias.slope", 0.02f, 0, 10, "texels", "The same for each unit of the receiver's slope against the light."},
      {"bias.normal_offset", 0.0f, 0, 10, "texels", "Shift of receivers along their normal."},
      pattern("sampling.blocker_pattern", "Points at which blockers are looked for."),
      pattern("sampling.filter_pattern", "Points that the filter compares."),
      {"sampling.scramble",
       std::string("rotate"),
       0,
       0,
       "",
       "What differs from pixel to pixel: a rotation of the points (disc suns) or a shift on the torus.",
       host,
       {"rotate", "shift"}},
      {"sampling.noise",
       std::string("blue"),
       0,
       0,
       "",
       "What decides the rotation or shift of a pixel: a tile of 64 × 64 pixels, or nothing.",
       host,
       {"none", "white", "blue", "void_and_cluster"}},
      sequence("sampling.blocker_sequence", "From frame to frame the blocker step's points stay, shift, or change."),
      sequence("sampling.filter_sequence", "The same for the filter's points."),
      {"sampling.seed", 0, 0, 65535, "", "Shifts the noise: another number turns all points another way.", host},
  };
}

}  // namespace penumbra::shadow

#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "../core/params.h"
#include "../gl/pass.h"
#include "cascades.h"

namespace penumbra::shadow {

// What a technique asks of the frame before its GLSL runs; built on demand, shared by all that ask.
enum Needs : unsigned {
  needs_nothing = 0,
  needs_shadow_map = 1u << 0,     // depth of the casters, one layer a cascade
  needs_depth_pyramid = 1u << 1,  // minimum and maximum depth over 2^n × 2^n texels
};

// Everything about one light in one frame that passes and techniques read.
struct LightFrame {
  Cascades cascades;
  float tan_half_angle = 0;
  unsigned depth = 0;                    // name of the depth array texture, one layer a cascade; 0 when not needed
  const gl::Texture* pyramid = nullptr;  // RG32F: minimum, maximum; level 0 is a quarter of the map's side
  int layer = 0;                         // of the mask
};

// What a resolve pass works on: the receivers and the mask that it fills.
struct ResolveInputs {
  gl::Device& device;
  const LightFrame& light;
  const ParamSet& params;
  unsigned depth = 0, normal = 0;  // texture names of the receivers
  const gl::Texture& mask;
};

// A technique is a value. Its GLSL file defines
//   Visibility visibility(Receiver receiver, Light light);
// and nothing in the drivers knows its name.
struct Technique {
  std::string name;
  std::string summary;  // one sentence
  std::string source;   // "Author Year, section"
  std::string glsl;     // file under glsl/, "shadow/techniques/pcss.glsl"
  unsigned needs = needs_shadow_map;
  // Rows named "<technique>.blocker_taps" and "<technique>.filter_taps" size the tables of sample points.
  std::vector<Param> params;
  // Fixes sampling.pattern and sampling.scramble; empty leaves them to the parameters.
  std::string pattern = {}, scramble = {};
  // Makes what only this technique needs from a light's maps, before the mask pass. Optional.
  std::function<void(gl::Device&, LightFrame&, const ParamSet&)> prepare = {};
  // Methods that are no function of one receiver fill the mask themselves; `glsl` of `stand_in` serves blended
  // surfaces.
  std::function<void(const ResolveInputs&)> resolve = {};
  std::string stand_in = {};
};

// Another name for a technique with some parameters set: "pcss_compute" is pcss with driver=compute.
struct Alias {
  std::string name, technique, summary;
  std::vector<std::string> assignments;
};

// The techniques that a renderer offers, a value that is passed in.
class Registry {
 public:
  Registry(std::vector<Technique> techniques, std::vector<Alias> aliases);

  std::span<const Technique> techniques() const { return techniques_; }
  std::span<const Alias> aliases() const { return aliases_; }
  std::vector<std::string> names() const;  // techniques and aliases
  // Throws Error with near names when unknown (aliases are resolved by select()).
  const Technique& find(std::string_view name) const;
  // Sets "technique" and, for an alias, its assignments.
  void select(ParamSet& params, std::string_view name) const;
  // The rows of the library and of every technique.
  std::vector<Param> params() const;

 private:
  std::vector<Technique> techniques_;
  std::vector<Alias> aliases_;
};

// The techniques of this library: none, hard, pcf, pcss, brute_force.
const Registry& built_in_registry();

}  // namespace penumbra::shadow

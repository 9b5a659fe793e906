#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "../core/params.h"
#include "../gl/pass.h"
#include "inputs.h"

namespace penumbra::shadow {

// What a technique asks of the frame before its GLSL runs; built on demand, shared by all that ask.
enum Needs : unsigned {
  needs_nothing = 0,
  needs_shadow_map = 1u << 0,     // depth of the casters, one layer a cascade
  needs_depth_pyramid = 1u << 1,  // minimum depth over 2^n × 2^n texels
};

// Texture units of the programs that evaluate a technique. Those from `first_pass_unit` to the last are free for the
// inputs of a technique's own passes; forward surfaces leave them to the caller.
enum TextureUnit : unsigned {
  unit_shadow_map = 0,
  unit_depth_pyramid,
  unit_receiver_depth,
  unit_receiver_normal,
  unit_noise,
  first_product_unit,
  first_pass_unit = 8,
  // Of the library's own passes.
  unit_motion = first_pass_unit,
  unit_last_surface,
  unit_movement,
  unit_last_texels,
  unit_texels,
  unit_notes,
  unit_count = 16,
};

// Uniform buffer bindings that the library uses, forward surfaces included.
enum UniformBinding : unsigned { block_params, block_shadow, block_samples, uniform_binding_count };

// A texture that a technique's GLSL reads at an explicit binding, from `first_product_unit` to before
// `first_pass_unit`.
struct Product {
  unsigned unit = first_product_unit;
  const gl::Texture* texture = nullptr;
  gl::SamplerDesc sampler = {};
};

// Everything about one light in one frame that passes and techniques read.
struct LightFrame {
  int view = 0, light = 0;  // ids
  int layer = 0;            // of the mask
  Rect viewport;            // of the receivers' textures and the mask
  LightProjection projection;
  LightShape shape;
  unsigned depth = 0;  // name of the depth array texture, the layers of the projection; 0 when not needed
  const gl::Texture* pyramid = nullptr;   // R32F: minimum; level 0 is a quarter of the map's side
  const gl::Texture* movement = nullptr;  // see movement_map.h; absent unless a history asks for it
  bool casters_moved = false;             // since the last frame: `movement` shows where
  bool history = false;                   // the last frame's shadow may be taken up
  // R8UI, of masks that went through history or filters: bits 0 to 3 cascade, 4 kernel smaller than a texel, 5 to 7 why
  // the history was refused (see History in docs/techniques.md).
  const gl::Texture* notes = nullptr;
  // Bound wherever the technique is evaluated. In a Mask: those that forward surfaces read, a stand-in's own if it has
  // one.
  std::vector<Product> products;
};

class TechniqueFrame;

// A technique is a value. Its GLSL file defines
//   float read_radius(Receiver receiver, Light light);
//   Visibility visibility(Receiver receiver, Light light);
// and nothing in the drivers knows its name.
struct Technique {
  std::string name;
  std::string summary;  // one sentence
  std::string source;   // "Author Year, section"
  std::string glsl;  // file under glsl/, "shadow/techniques/pcss.glsl"; empty: `resolve` does all, `stand_in` the rest
  unsigned needs = needs_shadow_map;
  // Rows named "<technique>.blocker_taps", "<technique>.filter_taps" and "<technique>.renewal_taps" (the filter's,
  // where there is a history and it is refused) size the tables of sample points.
  std::vector<Param> params;
  // Fixes both of sampling's patterns, and sampling.scramble; empty leaves them to the parameters.
  std::string pattern = {}, scramble = {};
  // Makes what only this technique needs from a light's maps, before the mask pass, and adds it to the light's
  // products. Optional.
  std::function<void(const TechniqueFrame&)> prepare = {};
  // Fills the mask's layer in passes of its own, of which TechniqueFrame::evaluate() can be one: methods that are no
  // function of one receiver. Optional; the library's history and filters do not apply to it.
  std::function<void(const TechniqueFrame&)> resolve = {};
  // The programs that `prepare` and `resolve` use under these parameters, by name. Their files may include all that the
  // technique's GLSL may, and are compiled with its constants. One without vertex and compute shader is for
  // TechniqueFrame::draw_caster_geometry(): the caster callback brings the vertex shader.
  std::function<std::vector<gl::ProgramDesc>(const ParamSet&)> programs = {};
  // The technique whose `glsl` serves blended surfaces, where this one's does not: with its own needs, `prepare` and
  // sample points.
  std::string stand_in = {};
};

// A filter on the packed texels of a mask (see glsl/lib/packed_texel.glsl). Its GLSL file defines
//   uint filtered(ivec2 pixel);
// in terms of what glsl/shadow/drivers/filter.glsl offers, and nothing there knows its name.
struct Filter {
  // What it changes: the mean blocker distance, before the size of any kernel is taken from it, or the visibility.
  enum class Of { penumbra, visibility };

  std::string name;
  std::string summary;  // one sentence
  std::string source;   // "Author Year, section"
  std::string glsl;     // file under glsl/
  Of of = Of::visibility;
  int passes = 1;
  // Pixels that a pass reads to each side of its own, along x and y: what the compute form shares in a group. No more
  // than fits into 32 KiB, else its compute form is the fragment one.
  std::vector<glm::ivec2> reach = {};
};

// Another name for a technique with some parameters set: "pcss_compute" is pcss with driver=compute.
struct Alias {
  std::string name, technique, summary;
  std::vector<std::string> assignments;
};

// The filters of this library: median, box, gaussian, bilateral, bilateral_separable.
std::vector<Filter> built_in_filters();

// The techniques and filters that a renderer offers, a value that is passed in.
class Registry {
 public:
  // `default_technique` is what the parameter "technique" begins with; empty: the first. Throws Error for techniques or
  // filters that share a name and for techniques that can't be evaluated: without glsl and resolve, without glsl for
  // blended surfaces (their own or a stand-in's), or with an unknown stand_in, pattern or scramble.
  Registry(std::vector<Technique> techniques, std::vector<Alias> aliases, std::string default_technique = {},
           std::vector<Filter> filters = built_in_filters());

  std::span<const Technique> techniques() const { return techniques_; }
  std::span<const Alias> aliases() const { return aliases_; }
  std::span<const Filter> filters() const { return filters_; }
  const std::string& default_technique() const { return default_technique_; }
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
  std::string default_technique_;
  std::vector<Filter> filters_;
};

// The techniques of this library: none, hard, pcf, pcss, brute_force; and the presets of Deligiannis 2019.
const Registry& built_in_registry();

}  // namespace penumbra::shadow

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "../core/params.h"
#include "denoiser.h"
#include "filter.h"
#include "recipe.h"
#include "technique.h"

namespace penumbra::shadow {

// Another name for a technique with some parameters set: "pcss_compute" is pcss with driver=compute.
struct Preset {
  std::string name, technique, summary;
  std::vector<std::string> assignments;  // "name=value"
};

// What this library provides of each kind; each one is defined in its own file and listed by one line of registry.cpp.
std::vector<Technique> built_in_techniques();
std::vector<Filter> built_in_filters();
std::vector<Denoiser> built_in_denoisers();
std::vector<Recipe> built_in_recipes();

// The techniques, presets, filters, denoisers and recipes that a renderer offers: a value that is passed to
// SoftShadows.
class Registry {
 public:
  struct Contents {
    std::vector<Technique> techniques;
    std::vector<Preset> presets = {};
    // The default of the parameter "technique"; empty: the first.
    std::string default_technique = {};
    std::vector<Filter> filters = built_in_filters();
    std::vector<Denoiser> denoisers = built_in_denoisers();  // the first is the parameter's default
    std::vector<Recipe> recipes = built_in_recipes();
  };

  // Throws Error, in one line that names the entry and the fault, for
  //   - two entries of one kind or two parameters with the same name; a name of an entry that is no lower-case
  //     identifier;
  //   - techniques that can't be evaluated: without glsl and resolve, without glsl for blended surfaces (their own or a
  //     stand-in's), or with an unknown stand_in, pattern or scramble;
  //   - sample sets whose count parameter is unknown, not an integer, or may exceed most_points; more sample points
  //     than a uniform buffer holds; two sets of one technique with the same name;
  //   - techniques that decide tiles and lack glsl, the shadow map or its pyramid among their needs;
  //   - needs that no recipe makes, recipes that need one listed after them, and more needs than there are texture
  //     units; recipes without build, denoisers without denoise.
  explicit Registry(Contents contents);

  const Contents& contents() const { return contents_; }
  std::span<const Technique> techniques() const { return contents_.techniques; }
  std::span<const Preset> presets() const { return contents_.presets; }
  std::span<const Filter> filters() const { return contents_.filters; }
  std::span<const Denoiser> denoisers() const { return contents_.denoisers; }
  std::span<const Recipe> recipes() const { return contents_.recipes; }
  const std::string& default_technique() const { return contents_.default_technique; }
  std::vector<std::string> names() const;  // techniques and presets
  // Throws Error with near names when unknown (presets are resolved by select()).
  const Technique& find(std::string_view name) const;
  // Throws Error with near names when unknown.
  const Filter& find_filter(std::string_view name) const;
  // Throws Error with near names when unknown.
  const Recipe& find_recipe(std::string_view name) const;
  // Null for "none". Throws Error with near names when unknown.
  const Denoiser* find_denoiser(std::string_view name) const;
  // Whether the mask can depend on a parameter under the technique and the denoiser that `chosen` selects: not on those
  // that only another technique or denoiser lists in its `params`.
  bool concerns(std::string_view param, const ParamSet& chosen) const;
  // Sets "technique" and, for a preset, its assignments. Throws Error with near names when unknown.
  void select(ParamSet& params, std::string_view name) const;
  // The parameters of the library, and of every denoiser, recipe and technique.
  std::vector<Param> params() const;

 private:
  Contents contents_;
};

// The techniques of this library and their presets: see registry.cpp.
const Registry& built_in_registry();

}  // namespace penumbra::shadow

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

// What this library has of each: one file and one line of registry.cpp a piece.
std::vector<Technique> built_in_techniques();
std::vector<Filter> built_in_filters();
std::vector<Denoiser> built_in_denoisers();
std::vector<Recipe> built_in_recipes();

// The techniques, and what they are made with and followed by, that a renderer offers: a value that is passed in.
class Registry {
 public:
  struct Contents {
    std::vector<Technique> techniques;
    std::vector<Preset> presets = {};
    // What the parameter "technique" begins with; empty: the first.
    std::string default_technique = {};
    std::vector<Filter> filters = built_in_filters();
    std::vector<Denoiser> denoisers = built_in_denoisers();  // the first is what the parameter "denoiser" begins with
    std::vector<Recipe> recipes = built_in_recipes();
  };

  // Throws Error, in one line that names the piece and the fault, for
  //   - two of a kind that share a name;
  //   - techniques that can't be evaluated: without glsl and resolve, without glsl for blended surfaces (their own or a
  //     stand-in's), or with an unknown stand_in, pattern or scramble;
  //   - sample sets whose count parameter is unknown, no whole number or may exceed most_points, more of them than a
  //     uniform buffer holds, and two of a technique that share a name;
  //   - needs that no recipe makes, or that a recipe has of one that comes after it, and more of them than there are
  //     texture units; recipes without build, denoisers without denoise.
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
  const Recipe& find_recipe(std::string_view name) const;
  // Null for "none".
  const Denoiser* find_denoiser(std::string_view name) const;
  // Sets "technique" and, for a preset, its assignments.
  void select(ParamSet& params, std::string_view name) const;
  // The rows of the library, and of every denoiser, recipe and technique.
  std::vector<Param> params() const;

 private:
  Contents contents_;
};

// The techniques of this library: none, hard, pcf, pcss, brute_force; and the presets of Deligiannis 2019.
const Registry& built_in_registry();

}  // namespace penumbra::shadow

#pragma once

#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "../core/params.h"
#include "pass_context.h"
#include "registry.h"

namespace penumbra::shadow {

// A program of the library's own passes. `before`: a file to be included before its fragment or compute shader.
struct LibraryProgram {
  gl::ProgramDesc desc;
  std::string before = {};
};

// The shader programs of a registry's techniques, recipes and denoisers. Each begins with a generated file, its
// preamble: the registry's parameters, the texture units of what it needs, its sample points. Registries with other
// rows or techniques have files of their own.
class Programs {
 public:
  Programs(gl::Device& device, const Registry& registry);

  // Constants that a technique's GLSL is compiled with; `rotated`: how its sample points differ from pixel to pixel.
  static std::vector<gl::Define> defines(const Technique& technique, const ParamSet& params, bool rotated);

  // How a technique's visibility() is driven. Apart, not by a uniform: a software rasteriser runs both sides of a
  // branch.
  struct MaskForm {
    bool rotated = true;
    bool compute = false;
    bool packed = false;   // packed texels and notes, for denoisers; else the mask itself
    bool history = false;  // packed, and what the history says
  };
  gl::ProgramDesc mask(const Technique& technique, const ParamSet& params, const MaskForm& form) const;
  // Packs a mask that a technique's `resolve` filled.
  gl::ProgramDesc pack(bool history) const;
  // A program of the library's, ready to be compiled.
  gl::ProgramDesc ready(const LibraryProgram& program) const;
  // The file that gives forward surfaces a technique's visibility().
  std::string forward_file(const Technique& technique) const;
  // The owner's `programs` under these parameters, ready to be compiled, and the names that they then have.
  std::vector<gl::ProgramDesc> own(const PassOwner& owner, const ParamSet& params, bool rotated) const;
  static std::string own_name(const PassOwner& owner, std::string_view program);

  // The defines of every variant of a technique, and all programs of every technique, recipe, filter and denoiser.
  std::vector<std::vector<gl::Define>> all_defines(const Technique& technique, const ParamSet& defaults) const;
  std::vector<gl::ProgramDesc> all(const ParamSet& defaults) const;

 private:
  std::string folder_of(const PassOwner& owner) const;
  std::string driver_file(const Technique& technique, std::string_view driver) const;
  void put_preamble(const PassOwner& owner, const ParamSet& params);
  // The name of a generated file in `folder` that includes those, in that order.
  std::string including(const std::string& folder, const std::vector<std::string>& files) const;
  void add_own(std::vector<gl::ProgramDesc>& programs, const PassOwner& owner, const ParamSet& defaults) const;

  gl::Device& device_;
  const Registry& registry_;
  std::string folder_;
  mutable std::set<std::string> put_;  // generated files that are there
};

}  // namespace penumbra::shadow

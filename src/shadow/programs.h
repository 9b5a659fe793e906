#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "technique.h"

namespace penumbra::shadow {

// A program of the library's own passes. `before`: a file to be included before its fragment or compute shader.
struct LibraryProgram {
  gl::ProgramDesc desc;
  std::string before = {};
};

// The shader programs of a registry's techniques. Each begins with the registry's parameters, in files that are
// generated here; registries with other rows or techniques have files of their own.
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
    bool packed = false;   // packed texels and notes, for history and filters; else the mask itself
    bool history = false;  // packed, and what the history says
  };
  gl::ProgramDesc mask(const Technique& technique, const ParamSet& params, const MaskForm& form) const;
  // A program of the library's, ready to be compiled.
  gl::ProgramDesc ready(const LibraryProgram& program) const;
  // The file that gives forward surfaces a technique's visibility().
  std::string forward_file(const Technique& technique) const;
  // Technique::programs(), ready to be compiled, and the names that they then have.
  std::vector<gl::ProgramDesc> own(const Technique& technique, const ParamSet& params, bool rotated) const;
  static std::string own_name(const Technique& technique, std::string_view program);

  // The defines of every variant of a technique, and all programs of every technique.
  std::vector<std::vector<gl::Define>> all_defines(const Technique& technique, const ParamSet& defaults) const;
  std::vector<gl::ProgramDesc> all(const ParamSet& defaults) const;

 private:
  std::string driver_file(const Technique& technique, std::string_view driver) const;
  std::string with_params(const std::string& file, const std::string& before = {}) const;

  gl::Device& device_;
  const Registry& registry_;
  std::string folder_;
};

}  // namespace penumbra::shadow

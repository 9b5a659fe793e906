#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "../core/params.h"
#include "pass_context.h"
#include "registry.h"
#include "samples.h"

namespace penumbra::shadow {

// A program of the library's own passes. `before`: a file to include in front of its fragment or compute shader.
struct LibraryProgram {
  gl::ProgramDesc desc;
  std::string before = {};
};

// The shader programs of a registry's techniques, recipes and denoisers. Each program begins with a generated file, its
// preamble: the declarations of the registry's parameters, of the texture units for its needs, and of its sample
// points. Registries with different parameters or techniques get separate files.
class Programs {
 public:
  Programs(gl::Device& device, const Registry& registry);

  // What a technique's GLSL is compiled for besides parameters. Programs that read no light's receivers ask the uniform
  // block which kind of light there is.
  struct Compiled {
    Scramble scramble = Scramble::rotate;
    bool lamp = false;  // else a sun
  };
  static Compiled compiled_for(const Technique& technique, const ParamSet& params, const LightShape& shape);
  // All that it can be for a technique.
  static std::vector<Compiled> all_compiled(const Technique& technique);
  // The constants that a technique's GLSL is compiled with.
  std::vector<gl::Define> defines(const Technique& technique, const ParamSet& params, const Compiled& compiled) const;

  // The variant of the program that runs a technique's visibility() for every pixel. Variants are separate programs,
  // not branches on a uniform, because a software rasteriser runs both sides of a branch.
  struct MaskForm {
    Compiled compiled;
    bool compute = false;
    bool scaled = false;         // the pixels are every n-th of a mask: marks those that can't stand for the others
    bool packed = false;         // packed texels and notes, for denoisers; else the mask itself
    bool history = false;        // packed, and the notes say whether the history is valid
    bool tiles = false;          // over the listed tiles alone
    bool listed_pixels = false;  // for a list of pixels alone; compute, not packed
    bool details = false;    // decided tiles alone: the mask has, or will have, more than one channel, or is a lamp's
    bool reads_all = false;  // for receivers that may read what few do: see lists_apart()
  };
  gl::ProgramDesc mask(const Technique& technique, const ParamSet& params, const MaskForm& form) const;
  // The programs that decide tiles and that fill the mask with them.
  struct DecideForm {
    bool lamp = false;
    bool second_layer = false;  // the technique reads one
  };
  gl::ProgramDesc decide_tiles(const Technique& technique, const DecideForm& form) const;
  gl::ProgramDesc decided(const MaskForm& form) const;
  // The program that lists the tiles that filters can change.
  gl::ProgramDesc filter_tiles(bool keeps_narrow) const;
  // The program that interpolates a mask between every n-th pixel: in all tiles, in those that are listed, or in those
  // that are listed apart. `details`: the mask has more than one channel.
  enum class UpsampledTiles : std::uint8_t { all, listed, listed_apart };
  gl::ProgramDesc upsample(UpsampledTiles tiles, bool details) const;
  // The program that filters pixels with noise that are listed one by one, and the one that stores the results.
  gl::ProgramDesc filter_noisy(bool stores) const;
  // Whether the driver can draw tiles as points: OpenGL 4.5 guarantees neither points of their size nor storage buffers
  // in vertex shaders. Asked of OpenGL once, by the first frame: programs are listed without a context too.
  bool draws_tiles() const;
  // The program that packs a mask which a technique's `resolve` filled.
  gl::ProgramDesc pack(bool history) const;
  // A program of the library, with its generated files in place, ready to be compiled.
  gl::ProgramDesc ready(const LibraryProgram& program) const;
  // The file that forward programs include for a technique's visibility().
  std::string forward_file(const Technique& technique) const;
  // The owner's `programs` with these parameters, ready to be compiled; own_name() is the name that each has then.
  std::vector<gl::ProgramDesc> own(const PassOwner& owner, const ParamSet& params, const Compiled& compiled) const;
  static std::string own_name(const PassOwner& owner, std::string_view program);

  // The defines of every variant of a technique, and all programs of every technique, recipe, filter and denoiser.
  std::vector<std::vector<gl::Define>> all_defines(const Technique& technique, const ParamSet& defaults) const;
  std::vector<gl::ProgramDesc> all(const ParamSet& defaults) const;

 private:
  std::string folder_of(const PassOwner& owner) const;
  std::string driver_file(const Technique& technique, std::string_view driver) const;
  void put_preamble(const PassOwner& owner, const ParamSet& params);
  // The name of a generated file in `folder` that includes `files`, in that order.
  std::string including(const std::string& folder, const std::vector<std::string>& files) const;
  void add_own(std::vector<gl::ProgramDesc>& programs, const PassOwner& owner, const ParamSet& defaults) const;

  gl::Device& device_;
  const Registry& registry_;
  std::string folder_;
  mutable std::optional<bool> draws_tiles_;
  mutable std::set<std::string> put_;  // names of the generated files made so far
};

}  // namespace penumbra::shadow

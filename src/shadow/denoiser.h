#pragma once

#include <functional>
#include <string>
#include <vector>

#include "../core/params.h"
#include "../gl/program.h"

namespace penumbra::shadow {

class DenoiseContext;

// Reduces the noise of a technique that takes few sample points, by filters and by blending with earlier frames. The
// parameter "denoiser" chooses one, or no_denoiser().
struct Denoiser {
  // A texture of the mask's size that is kept from one frame to the next, for each light in each view.
  struct Remembered {
    std::string name;
    GLenum format;
  };

  std::string name;
  std::string summary;  // one sentence
  std::string source;   // "Author Year, section"
  // The textures of a light that its passes read, by name, like Technique::needs; also "movement_map", which is drawn
  // only if `remembers` is not empty (see movement_map.h).
  std::vector<std::string> needs = {};
  std::vector<Param> params = {};
  // Whether it does anything with these parameters; if not, the technique writes the mask directly. Absent: always.
  std::function<bool(const ParamSet&)> applies = {};
  // What it keeps for the next frame with these parameters; absent or empty: nothing, so no frame depends on an earlier
  // one.
  std::function<std::vector<Remembered>(const ParamSet&)> remembers = {};
  // Runs its steps in order, from DenoiseContext::evaluate_packed() to the filled layer of the mask.
  std::function<void(const DenoiseContext&)> denoise;
  // Its own programs that `denoise` uses with these parameters, by name, like Technique::programs.
  std::function<std::vector<gl::ProgramDesc>(const ParamSet&)> programs = {};
};

// What "none" chooses, for lists of what can be chosen: it has no steps, and no registry holds it.
const Denoiser& no_denoiser();

}  // namespace penumbra::shadow

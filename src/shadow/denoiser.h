#pragma once

#include <functional>
#include <string>
#include <vector>

#include "../core/params.h"
#include "../gl/program.h"

namespace penumbra::shadow {

class DenoiseContext;

// What follows a technique, so that few sample points are enough: filters, and blends with earlier frames. The
// parameter "denoiser" chooses one, or "none".
struct Denoiser {
  // A texture of the mask's size that it takes from one frame to the next, for each light in each view.
  struct Remembered {
    std::string name;
    GLenum format = GL_R32UI;
  };

  std::string name;
  std::string summary;  // one sentence
  std::string source;   // "Author Year, section"
  // What its passes read of a light, by name, as Technique::needs; besides "movement_map", which is drawn where
  // `remembers` is not empty (see movement_map.h).
  std::vector<std::string> needs = {};
  std::vector<Param> params = {};
  // Whether it does anything under these parameters: else the technique writes the mask itself. Absent: always.
  std::function<bool(const ParamSet&)> applies = {};
  // What it remembers under these parameters; absent or empty: nothing, so that no frame depends on an earlier one.
  std::function<std::vector<Remembered>(const ParamSet&)> remembers = {};
  // Its steps in order: from DenoiseContext::evaluate_packed() to the mask's layer.
  std::function<void(const DenoiseContext&)> denoise;
  // The programs of its own that `denoise` uses under these parameters, by name, as Technique::programs.
  std::function<std::vector<gl::ProgramDesc>(const ParamSet&)> programs = {};
};

}  // namespace penumbra::shadow

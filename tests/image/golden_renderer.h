#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gl/pass.h"
#include "image/golden_picture.h"
#include "image/goldens.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "scene/gpu_scene.h"
#include "scene/scene.h"
#include "truth/technique.h"

namespace penumbra::test {

// Draws golden pictures. Scenes stay read, and programs compiled, from one to the next.
class GoldenRenderer {
 public:
  // Draws all frames of a golden picture; `more`: further settings. aov() reads the last frame.
  void draw(const Golden& golden, const std::vector<const char*>& more = {});
  std::vector<float> aov(const char* name) const { return renderer_.read_aov(name); }
  // The last frame as the golden picture's file stores it.
  GoldenPicture picture(const Golden& golden) const;

 private:
  struct Loaded {
    scene::Scene scene;
    std::optional<scene::GpuScene> gpu;
  };

  Loaded& load(const std::string& name);

  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
  std::map<std::string, Loaded> scenes_;
  truth::TruthTechnique truth_{{.cache = {}}};
  shadow::Registry registry_ = truth_.registry();
  render::Renderer renderer_{device_, registry_};
};

// The parameters with which a golden picture is drawn.
ParamSet params_of(const Golden& golden, const shadow::Registry& registry);
// The denoiser that is applied in a golden picture; null for none.
const shadow::Denoiser* denoiser_of(const Golden& golden, const shadow::Registry& registry);
// Whether a golden picture is there to show what its denoiser keeps from frame to frame: it has several frames, and one
// of the settings in `without` is a parameter of the denoiser.
bool shows_history(const Golden& golden, const shadow::Registry& registry);

}  // namespace penumbra::test

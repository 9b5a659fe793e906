#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/params.h"
#include "gl/pass.h"
#include "render/renderer.h"
#include "scene/gpu_scene.h"
#include "shadow/pass_context.h"
#include "shadow/registry.h"

namespace penumbra::bench {

// Measures a lower bound (floor) of a technique's cost with frames that do only the work that the technique can't
// avoid: the pass "shadow mask" does nothing but its fetches, as many from the same discs of the same map, and the pass
// "mask copy" reads and writes the mask, with its details, once. The filter's discs are those of the technique's mask,
// which a denoiser may have changed.
//
// Techniques whose parameters do not say how many texels they read have no fetch floor. It bounds the
// others only where they make all fetches, also those whose result they know: see values_for_floor().
class Floor {
 public:
  // `params`: the technique's. `technique` is copied; `scene` must outlive this object.
  Floor(const shadow::Technique& technique, const ParamSet& params, const scene::Scene& scene, gl::ShaderFiles shaders,
        gl::Timers::Mode timing);

  // Copies the filter radii of each pixel from a mask that the technique has drawn.
  void take_kernels(const gl::Texture& mask);
  // `params`: the technique's.
  const render::Frame& draw(const render::FrameInputs& inputs, const ParamSet& params);

  bool has_fetches() const { return has_fetches_; }
  gl::Timers& timers() { return device_.timers; }

 private:
  ParamSet params_for(const ParamSet& params) const;

  shadow::Technique technique_;
  bool has_fetches_;
  std::unique_ptr<gl::Texture> kernels_;  // the registered floor technique keeps a reference to it
  gl::Device device_;
  scene::GpuScene scene_;
  render::Renderer renderer_;
};

// The values with which a technique computes every pixel of its mask by all its fetches.
std::vector<std::pair<std::string, ParamValue>> values_for_floor(const ParamSet& params);

}  // namespace penumbra::bench

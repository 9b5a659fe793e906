#pragma once

#include <memory>

#include "core/params.h"
#include "gl/pass.h"
#include "render/renderer.h"
#include "scene/gpu_scene.h"
#include "shadow/pass_context.h"
#include "shadow/registry.h"

namespace penumbra::bench {

// Frames that draw, instead of a technique, only what it could not do without: in the pass "shadow mask" its fetches
// alone, as many from the same discs of the same map, and in the pass "mask copy" one read and one write of the mask.
//
// Techniques that say nothing of taps have no fetch floor. A technique that leaves out fetches where it knows their
// result can be under its floor: switch that off to compare like with like (pcss.early_exit=off).
class Floor {
 public:
  // `technique` is copied; `scene` outlives this.
  Floor(const shadow::Technique& technique, const scene::Scene& scene, gl::ShaderFiles shaders,
        gl::Timers::Mode timing);

  // Takes the radii of the technique's filter from a mask of its own.
  void take_kernels(const gl::Texture& mask);
  // `params`: the technique's.
  void draw(const render::FrameInputs& inputs, const ParamSet& params);

  bool has_fetches() const { return has_fetches_; }
  gl::Timers& timers() { return device_.timers; }

 private:
  ParamSet params_for(const ParamSet& params) const;

  shadow::Technique technique_;
  bool has_fetches_;
  std::unique_ptr<gl::Texture> kernels_;  // its address is the floor technique's for good
  gl::Device device_;
  scene::GpuScene scene_;
  render::Renderer renderer_;
};

}  // namespace penumbra::bench

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "compare/camera_path.h"
#include "compare/comparison.h"
#include "compare/drawing.h"
#include "gl/pass.h"
#include "metrics/sequence.h"
#include "scene/gpu_scene.h"

namespace penumbra::compare {

// What all techniques of a scene have in common.
struct DrawnScene {
  const CompareOptions& options;
  gl::Device& device;
  const shadow::Registry& techniques;
  scene::GpuScene& scene;
  const CameraPath& path;
  int lights;                          // that cast shadows
  const std::function<void()>& drawn;  // called after each frame of the range
};

// A frame of the reference: of the lights that cast shadows, one below the other.
struct ReferenceFrame {
  std::vector<float> visibility;
  std::vector<std::uint8_t> receivers;  // render::receivers_of()
};

// How many frames are drawn besides the one that counts: a single picture of a technique with a history is drawn until
// the history has converged.
int warmup_of(const CompareOptions& options, const ParamSet& params);

// How often a single picture is drawn again, for its cost; 0 for sequences and without costs.
int cost_frames_of(const CompareOptions& options);

// Draws the reference's frames; `last` receives the pictures of the last one.
std::vector<ReferenceFrame> draw_reference(const DrawnScene& scene, const ParamSet& params, ComparedPictures& last);

// Draws the part's contenders over all frames and measures them against the reference; `params` has one set for each
// contender of the comparison, in order. Where their cost is measured they are drawn alternately, frame by frame, so
// that a machine that slows down during the run slows all of them alike.
std::vector<ComparedTechnique> draw_techniques(const DrawnScene& scene, const Part& part,
                                               const std::vector<ParamSet>& params,
                                               const std::vector<ReferenceFrame>& reference);

}  // namespace penumbra::compare

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/options.h"
#include "core/params.h"
#include "gl/context.h"
#include "metrics/sequence.h"
#include "render/view.h"

namespace penumbra::compare {

// A technique's errors over all frames, see metrics/. Figures that could not be measured are NaN.
struct ComparedFigures {
  double rmse = 0, psnr = 0;                    // all receivers
  double rmse_penumbra = 0, psnr_penumbra = 0;  // pixels that are in the penumbra in the reference
  double bias = 0, max = 0, p99 = 0;
  double ssim = 0, flip = 0, width_error = 0;  // means over the frames
  double width_lost = 0;                       // share of penumbra pixels in which the shadow has no width to measure
  std::optional<metrics::SequenceFigures> sequence;  // set if there is more than one frame
};

// Milliseconds that the passes between G-buffer and lighting took in a frame.
struct ShadowCost {
  double median = 0, min = 0, max = 0;
  std::size_t frames = 0;
};

// The last frame's pictures. Those of the shadows show each light that casts some, one below the other.
struct ComparedPictures {
  std::vector<std::uint8_t> display;  // RGB, sRGB
  std::vector<float> visibility;
  std::vector<float> error;  // visibility minus the reference's; NaN where there is no receiver
};

struct ComparedTechnique {
  std::string label;
  ParamSet params;
  ShadowCost cost;
  std::size_t shadow_bytes = 0;  // of maps, masks and history
  ComparedFigures figures;
  ComparedPictures pictures;
};

struct ComparedScene {
  std::string path;
  std::size_t receivers = 0, pixels = 0;   // of the last frame: of the masks of all lights
  ComparedPictures reference;              // without an error
  render::Camera camera;                   // of the first frame
  std::vector<render::FrameLight> lights;  // those that cast shadows: all are compared
  glm::vec3 target{0};                     // what that camera looks at
  std::vector<ComparedTechnique> techniques;
};

// A direction in the form that --sun takes, in degrees.
struct Angles {
  double azimuth = 0;    // from +Z towards +X
  double elevation = 0;  // over the horizon
};
Angles angles_of(const glm::vec3& to_light);

struct Comparison {
  gl::DeviceInfo device;
  std::string backend;
  ParamSet reference_params;
  std::vector<ComparedScene> scenes;
};

// Draws and measures the whole comparison. Throws Error.
Comparison compare(const CompareOptions& options, const ComparedValues& values);

}  // namespace penumbra::compare

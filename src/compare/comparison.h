#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "compare/options.h"
#include "core/params.h"
#include "io/report.h"
#include "metrics/sequence.h"
#include "render/view.h"
#include "report/page.h"

namespace penumbra::compare {

// A technique's errors over all frames, see metrics/. Figures that could not be measured are NaN.
struct ComparedFigures {
  double rmse = 0, psnr = 0;                    // all receivers
  double rmse_penumbra = 0, psnr_penumbra = 0;  // pixels that are in the penumbra in the reference
  double bias = 0, max = 0, p99 = 0;
  double ssim = 0, flip = 0, width_error = 0;  // means over the frames
  double width_lost = 0;                       // share of penumbra pixels in which the shadow has no width to measure
  std::size_t not_finite = 0;  // values of receivers that are NaN or infinite, of all frames; each counts as |e| = 1
  std::optional<metrics::SequenceFigures> sequence;  // set if there is more than one frame
};

// Milliseconds that the passes between G-buffer and lighting took in a frame; NaN if no cost was measured.
struct ShadowCost {
  double median = 0, min = 0, max = 0;
  std::size_t frames = 0;
};

// The last frame's pictures, as a report shows them. Those of the shadows show each light that casts some, one below
// the other.
struct ComparedPictures {
  report::EncodedPicture display, visibility;
  // Visibility minus the reference's, NaN where there is no receiver: packed floats (image/packed.h). The scale of its
  // colours depends on all techniques of the scene. Empty for the reference.
  std::vector<std::byte> error;
};

struct ComparedTechnique {
  std::string label;
  const ParamSet* params = nullptr;  // of the comparison's ComparedValues, which outlive it
  ShadowCost cost;
  std::size_t shadow_bytes = 0;  // of maps, masks and history
  ComparedFigures figures;
  ComparedPictures pictures;
};

struct ComparedScene {
  std::string path;
  std::size_t receivers = 0, pixels = 0;   // of the last frame: of the masks of all lights
  ComparedPictures reference;              // without an error; of a part without the first technique: none
  render::Camera camera;                   // of the first frame
  std::vector<render::FrameLight> lights;  // those that cast shadows: all are compared
  glm::vec3 target{0};                     // what that camera looks at
  std::vector<ComparedTechnique> techniques;
};

// How many of a technique's values are not finite, in words.
std::string not_finite_text(const ComparedTechnique& technique);

// What drew the pictures.
struct DrawnBy {
  io::Json device;  // as reports describe it
  std::string backend;
  std::string timed_on;  // what times depend on (bench::described()); empty if there are none
};

// A whole comparison, as its reports need it: scenes are added in order by add_scene() (page.h).
struct Comparison {
  DrawnBy drawn_by;
  ParamSet reference_params;
  std::vector<std::string> names;         // of all scenes, as the page has them
  std::vector<ComparedScene> scenes;      // without pictures
  std::vector<report::Section> sections;  // of the page, one for each scene, with the pictures
};

// Draws and measures the whole comparison. Throws Error.
Comparison compare(const CompareOptions& options, const ComparedValues& values);

}  // namespace penumbra::compare

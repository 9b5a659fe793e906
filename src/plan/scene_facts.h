#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "cli/options.h"
#include "core/params.h"
#include "plan/plan.h"
#include "scene/gltf.h"
#include "session/prepared_scene.h"
#include "shadow/registry.h"

namespace penumbra::plan {

// A file that drawing reads.
struct SceneFile {
  std::filesystem::path path;
  std::string shader = {};  // see PlannedFile
};

// What planning has to know about a scene.
struct SceneFacts {
  io::Json view;                 // camera and light at --time, for readers
  std::vector<SceneFile> files;  // all that drawing reads: the scene's, and those of --glsl
  double triangles = 0;          // drawn in a frame
  double lights = 1;             // that cast shadows
  double bytes = 0;              // of its files
  double decoded_mib = 0;        // vertices and images in memory
};

// Reads scenes without their images, but adds up how much memory these would take, decoded.
class ImageSizes {
 public:
  explicit ImageSizes(scene::ImageProbe probe) : probe_(std::move(probe)) {}

  // Gives one white pixel for each image. This object must outlive it.
  scene::ImageDecoder decoder();
  double bytes() const { return bytes_; }

 private:
  scene::ImageProbe probe_;
  double bytes_ = 0;
};

// All files in the folder of --glsl, at any depth, in the order of their names; none without --glsl. Throws Error if it
// is empty.
std::vector<SceneFile> shaders_of(const cli::DeviceOptions& device);

SceneFacts facts_of(const session::PreparedScene& prepared, const cli::DeviceOptions& device, const ImageSizes& images);

// What is drawn with one set of parameters.
struct Drawn {
  const ParamSet* params = nullptr;
  int frames = 1;
  int samples = 1;           // of each pixel: render::FrameInputs::samples
  bool own_shadows = false;  // render::FrameInputs::own_shadows
};

// The estimate, to a tenth, of drawing `drawn` at `pixels` (supersampling included). `kept_bytes`: what is in memory
// besides, for each pixel. The constants are fitted to runs in software (docs/clusters.md compares both).
Estimate estimate_of(const SceneFacts& facts, const cli::Size& pixels, std::span<const Drawn> drawn,
                     const shadow::Registry& registry, double kept_bytes);

}  // namespace penumbra::plan

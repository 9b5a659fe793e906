#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/viewer/camera_rig.h"
#include "core/params.h"
#include "studio/options.h"
#include "studio/stage.h"

namespace penumbra::app {

// The last one that --frames takes.
constexpr int last_frame = 999'999;

// What is shown, in the terms of `penumbra render`: its options and the values of the parameters. Time is that of frame
// `frame`, counted from --time at --fps.
struct Document {
  studio::StageOptions stage;
  ParamSet params;
  int frame = 0;

  // So many frames on: past the last that render takes it begins anew, before the first there is none.
  void step(int frames);
  double seconds() const { return studio::time_of(stage, frame); }
};

// Frames that come before a picture at rest: techniques with memory need them.
int warmup_of(const Document& document);

// The scene and what stands before the camera, as arguments of `penumbra render`.
std::vector<std::string> stage_arguments(const studio::StageOptions& stage);

// The arguments of `penumbra render` that draw this picture: "render", the scene, …, with all that is not a default.
// `warmup` frames come before it, for techniques with memory; `glsl` is --glsl's folder, or empty; `range`: these
// frames instead of the present one.
std::vector<std::string> render_arguments(const Document& document, const std::string& output, int warmup,
                                          const std::string& glsl, std::optional<studio::FrameRange> range = {});

// Where the camera and the sun stand in the present frame, as a hand takes them up.
CameraRig present_rig(const Document& document, const studio::Stage& stage);
studio::Direction present_sun(const Document& document, const studio::Stage& stage);

// Has the camera stand free where the rig is: the options' --eye, --target and --fov.
void place(Document& document, const studio::Stage& stage, const CameraRig& rig);
// Has the sun stand at a direction: the options' --sun.
void place_sun(Document& document, const glm::vec3& to_light);

// Camera numbers as `render` takes them: "--eye 1,2,3 --target 0,0,0 --fov 40"; "--camera NAME" where one of the file's
// is looked through, empty where the scene's own is.
std::vector<std::string> camera_arguments(const studio::StageOptions& stage);

}  // namespace penumbra::app

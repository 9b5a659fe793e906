#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options.h"
#include "core/params.h"
#include "session/prepared_scene.h"
#include "viewer/camera_rig.h"

namespace penumbra::viewer {

// The last one that --frames takes.
constexpr int last_frame = 999'999;

// What is shown, in the terms of `penumbra render`: its options and the values of the parameters. Time is that of frame
// `frame`, counted from --time at --fps.
struct Document {
  cli::SceneOptions options;
  ParamSet params;
  int frame = 0;

  // So many frames on: past the last that render takes it begins anew, before the first there is none.
  void step(int frames);
  double seconds() const { return session::time_of(options, frame); }
};

// Frames that come before a picture at rest: techniques with memory need them.
int warmup_of(const Document& document);

// The scene and what stands before the camera, as arguments of `penumbra render`.
std::vector<std::string> scene_arguments(const cli::SceneOptions& options);

// The arguments of `penumbra render` that draw this picture: "render", the scene, …, with all that is not a default.
// `warmup` frames come before it, for techniques with memory; `glsl` is --glsl's folder, or empty; `range`: these
// frames instead of the present one.
std::vector<std::string> render_arguments(const Document& document, const std::string& output, int warmup,
                                          const std::string& glsl, std::optional<cli::FrameRange> range = {});

// Where the camera and the sun stand in the present frame, as a hand takes them up.
CameraRig present_rig(const Document& document, const session::PreparedScene& prepared);
cli::Direction present_sun(const Document& document, const session::PreparedScene& prepared);

// Has the camera stand free where the rig is: the options' --eye, --target and --fov.
void place(Document& document, const session::PreparedScene& prepared, const CameraRig& rig);
// Has the sun stand at a direction: the options' --sun.
void place_sun(Document& document, const glm::vec3& to_light);

// Camera numbers as `render` takes them: "--eye 1,2,3 --target 0,0,0 --fov 40"; "--camera NAME" where one of the file's
// is looked through, empty where the scene's own is.
std::vector<std::string> camera_arguments(const cli::SceneOptions& options);

}  // namespace penumbra::viewer

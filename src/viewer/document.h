#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options.h"
#include "core/params.h"
#include "session/prepared_scene.h"
#include "viewer/camera_rig.h"

namespace penumbra::viewer {

// The highest frame number that --frame and --frames take.
constexpr int last_frame = 999'999;

// What the viewer shows, in the terms of `penumbra render`: its options and the values of the parameters. The time is
// that of frame `frame`, counted from --time at --fps.
struct Document {
  cli::SceneOptions options;
  ParamSet params;
  int frame = 0;

  // Moves by `frames`: past the last frame it starts again at 0, and it stops at 0 going backwards.
  void step(int frames);
  double seconds() const { return session::time_of(options, frame); }
};

// Frames to draw before a picture is finished: techniques with a history need them.
int warmup_of(const Document& document);

// Whether a picture may change after its first frame though nothing else does: by a history, or once it is traced.
bool changes_once_drawn(const Document& document);
// Whether a finished picture is drawn once more with shadows of their own for all samples of its pixels. Not where they
// have a history, which each sample would lack, nor where they are traced.
bool refines(const Document& document);
// Frames to draw until a picture is finished. On a GPU one that does not change is drawn often, so that what its passes
// cost can be measured.
int frames_of(const Document& document, bool software);

// Camera, sun, lights and lamps as arguments of `penumbra render`.
std::vector<std::string> view_arguments(const cli::SceneOptions& options);

// Scene, size, view, ground and time as arguments of `penumbra render`.
std::vector<std::string> scene_arguments(const cli::SceneOptions& options);

// The arguments of `penumbra render` that draw this picture: "render", the scene, …, with everything that is not a
// default. `warmup` frames come before it, for techniques with a history; `glsl` is --glsl's folder, or empty; `range`:
// these frames instead of the present one.
std::vector<std::string> render_arguments(const Document& document, const std::string& output, int warmup,
                                          const std::string& glsl, std::optional<cli::FrameRange> range = {});

// Two documents with the same text have the same picture.
std::string text_of(const Document& document);

// Lights that the options choose by name are chosen by index from then on, so that they can be compared. `names` are
// those of render::light_names().
void use_light_indices(cli::SceneOptions& options, const std::vector<std::string>& names);

// Camera and sun in the present frame, for the user to move.
CameraRig present_rig(const Document& document, const session::PreparedScene& prepared);
cli::Direction present_sun(const Document& document, const session::PreparedScene& prepared);

// Puts the camera where the rig is: sets the options' --eye, --target and --fov.
void place(Document& document, const session::PreparedScene& prepared, const CameraRig& rig);
// Puts the sun in a direction: sets the options' --sun.
void place_sun(Document& document, const glm::vec3& to_light);

// The camera as `render` takes it: "--eye=1,2,3 --target=0,0,0 --fov=40", or "--camera=NAME" for one of the file's;
// empty for the one that is chosen by default.
std::vector<std::string> camera_arguments(const cli::SceneOptions& options);

}  // namespace penumbra::viewer

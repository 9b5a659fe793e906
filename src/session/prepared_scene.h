#pragma once

#include <memory>
#include <set>
#include <string>

#include "cli/no_effect.h"
#include "cli/options.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "scene/gltf.h"
#include "scene/reach.h"
#include "scene/scene.h"

namespace penumbra::session {

// A scene ready to be drawn: with its ground, and with the camera and the sun that the options and the file choose.
struct PreparedScene {
  scene::Scene scene;
  scene::Bounds bounds;  // at --time, without the ground
  render::Setup setup;   // at --time
  // Same as FrameInputs::told_hidden, of this scene's frames.
  std::shared_ptr<std::set<int>> told_hidden = std::make_shared<std::set<int>>();
  // What was logged while camera and lights were chosen: it is logged once, however often they are chosen again.
  std::set<std::string> told = {};
  scene::ReachBound reach = {};  // of an animated scene, without the ground
};

// The reader checks how far the scene reaches at rest, and this at a time of its animations. Throws Error that names
// the file.
void check_extent(const scene::Scene& scene, double seconds);

// Adds the ground and chooses camera and sun. Choices that depend on the scene's bounds use the bounds at --time, so
// that they are the same in all frames of a sequence, whichever is drawn first. Throws Error.
PreparedScene prepare_scene(scene::Scene scene, const cli::SceneOptions& options);

// Reads the scene and sets it up. Throws Error.
PreparedScene load_scene(const cli::SceneOptions& options, const scene::ImageDecoder& decode);

// The kinds of light that shine on it, for cli::warn_without_lights().
cli::LightKinds kinds_of_light(const PreparedScene& prepared);

// Chooses camera and sun again for changed options. Scene and ground stay as they are. Throws Error.
void update_view(PreparedScene& prepared, const cli::SceneOptions& options);

// The setup at a time: a camera and a sun of the file follow its animation.
render::Setup setup_at(const PreparedScene& prepared, double seconds);

// The time of a frame, and of the frame before it.
struct FrameTime {
  double time = 0, last_time = 0;  // seconds
  bool cut = false;                // there is no frame before it, so it starts without history
};
// The inputs of a frame of `pixels`: camera and sun at its time, motion since the last one, and a cut where an
// animation jumps in between. Throws Error that names the file if the scene reaches too far at one of the times.
render::FrameInputs frame_inputs(const PreparedScene& prepared, const cli::Size& pixels, const FrameTime& when);

// The time of a frame in seconds. Frame 0 is at --time; a single picture is frame 0.
double time_of(const cli::SceneOptions& options, int frame);

}  // namespace penumbra::session

#pragma once

#include "render/setup.h"
#include "scene/gltf.h"
#include "scene/scene.h"
#include "studio/options.h"

namespace penumbra::studio {

// What stands before the camera: the scene with its ground, and all that the options and the scene settle.
struct Stage {
  scene::Scene scene;
  scene::Bounds bounds;  // at --time, without the ground
  render::Setup setup;   // at --time
};

// Sets a scene up. What is chosen from its bounds is chosen at --time, so that it is the same in all frames of a
// sequence, wherever one starts. Throws Error.
Stage set_up(scene::Scene scene, const StageOptions& options);

// Reads the scene and sets it up. Throws Error.
Stage load_stage(const StageOptions& options, const scene::ImageDecoder& decode);

// Chooses camera and sun anew for options that changed. Scene and ground stay. Throws Error.
void aim(Stage& stage, const StageOptions& options);

// The setup at a moment: a camera and a sun of the file follow its animation.
render::Setup setup_at(const Stage& stage, double seconds);

// When a frame is, seconds: frames count from 0 at --time; a single picture is frame 0.
double time_of(const StageOptions& options, int frame);

}  // namespace penumbra::studio

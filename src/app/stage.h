#pragma once

#include "app/render_options.h"
#include "render/setup.h"
#include "scene/scene.h"

namespace penumbra::app {

// What stands before the camera: the scene with its ground, and all that the options and the scene settle.
struct Stage {
  scene::Scene scene;
  render::Camera camera;
  render::Sun sun;
};

// Reads the scene and sets it up for its first picture. Throws Error.
Stage load_stage(const RenderOptions& options);

// When a frame is, seconds: frames count from 0 at --time; a single picture is frame 0.
double time_of(const RenderOptions& options, int frame);

}  // namespace penumbra::app

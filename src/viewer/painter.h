#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gl/pass.h"
#include "render/renderer.h"
#include "scene/gpu_scene.h"
#include "session/prepared_scene.h"
#include "viewer/document.h"

namespace penumbra::viewer {

// A scene that is shown: on the CPU and on the GPU.
struct LoadedScene {
  LoadedScene(gl::Device& device, session::PreparedScene loaded)
      : prepared(std::move(loaded)), gpu(device, prepared.scene) {}

  session::PreparedScene prepared;
  scene::GpuScene gpu;
  std::vector<std::string> cameras = render::camera_names(prepared.scene);
};

// One of the pictures that are compared, and what was drawn last of it.
class Painter {
 public:
  // `view` tells painters apart that share a renderer.
  Painter(gl::Device& device, render::Renderer& renderer, int view);

  // Whether this document, at whatever size, is what was drawn last.
  bool shows(const Document& document) const;
  // Draws the document's picture, its sides divided by `divisor`, with the motion since the last one. Throws Error.
  void draw(LoadedScene& scene, const Document& document, int divisor);
  // The next picture takes up nothing of the last: another scene, other shaders, the first of a picture at rest.
  void cut() {
    cut_ = true;
    frames_ = 0;
  }
  // The present picture is to be drawn once more: what it shows was not ready.
  void again() { frames_ = 0; }

  // There is no picture.
  void forget();

  // Pictures of the present state at full size, drawn since it changed.
  int frames() const { return divisor_ == 1 ? frames_ : 0; }
  double milliseconds() const { return milliseconds_; }

  // As it is shown, RGBA8; stays until the next draw().
  const gl::Texture& picture() const { return *picture_; }
  bool has_picture() const { return picture_ != nullptr; }

 private:
  void keep(const gl::Texture& display);

  gl::Device& device_;
  render::Renderer& renderer_;
  int view_;
  const gl::Texture* picture_ = nullptr;
  std::string drawn_;  // what was, in words
  int divisor_ = 1, frames_ = 0;
  double milliseconds_ = 0, last_time_ = 0;
  render::Camera last_camera_;
  bool cut_ = true;
};

}  // namespace penumbra::viewer

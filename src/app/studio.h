#pragma once

#include <memory>

#include "app/render_options.h"
#include "app/stage.h"
#include "gl/context.h"
#include "gl/pass.h"
#include "render/renderer.h"
#include "scene/gpu_scene.h"

namespace penumbra::app {

// A context and all that draws a stage in it. Members are in the order of their making: what is made last goes first.
class Studio {
 public:
  Studio(const RenderOptions& options, std::unique_ptr<gl::Context> context, const Stage& stage);

  // Draws frame `frame`, with the motion since the frame before it.
  void draw(int frame, const ParamSet& params);

  const render::Renderer& renderer() const { return renderer_; }
  gl::Device& device() { return device_; }
  const gl::Context& context() const { return *context_; }
  const gl::DeviceInfo& device_info() const { return device_info_; }

 private:
  const RenderOptions& options_;
  const Stage& stage_;
  std::unique_ptr<gl::Context> context_;
  gl::DeviceInfo device_info_;
  gl::Device device_;
  scene::GpuScene scene_;
  render::Renderer renderer_;
};

// The context that the options ask for, current. Throws Error, also where it can't draw a picture of their size.
std::unique_ptr<gl::Context> open_context(const RenderOptions& options);

}  // namespace penumbra::app

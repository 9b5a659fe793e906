#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gl/context.h"
#include "render/renderer.h"
#include "scene/gpu_scene.h"
#include "session/prepared_scene.h"
#include "session/render_device.h"

namespace penumbra::session {

// Owns what a command draws its frames with: a context, a device, a scene on the GPU and a renderer.
class RenderSession {
 public:
  // `options` and `prepared` must outlive the session. `device_options` names the folder of shaders that replace
  // built-in ones. `timed`: whether each pass is timed.
  RenderSession(const cli::SceneOptions& options, const cli::DeviceOptions& device_options,
                std::unique_ptr<gl::Context> context, const PreparedScene& prepared, shadow::Registry techniques,
                bool timed);

  // Draws frame `frame`, with the motion since the frame before it. Techniques keep their history if that one was the
  // last drawn and no animation jumps in between. `samples`: render::FrameInputs::samples.
  void draw(int frame, const ParamSet& params, int samples = 1);
  // Draws the last frame again without advancing time. Used to measure what a technique with a history costs once the
  // history exists.
  void redraw(const ParamSet& params, int samples = 1);

  // From now on frames keep what the AOVs need whose render::Aov::mask_details is set.
  void keep_mask_details() { mask_details_ = true; }
  // From now on frames of several samples have these AOVs as render::FrameInputs::averaged_aovs.
  void average_aovs(std::vector<std::string> names) { averaged_aovs_ = std::move(names); }

  // The next frame starts without history, as the first of a run. Call it when shaders have changed.
  void cut() { drawn_time_.reset(); }
  // Draws another scene from now on, with the same context and programs; the next frame starts without history.
  // `prepared` must outlive the session. If it throws Error, the old scene is kept.
  void show(const PreparedScene& prepared);

  // Camera and sun of the last frame.
  const render::Setup& setup() const { return setup_; }
  const render::Renderer& renderer() const { return renderer_; }
  gl::Device& device() { return device_.device; }
  const gl::Context& context() const { return *context_; }
  const gl::DeviceInfo& device_info() const { return device_.info; }

 private:
  void draw_at(const FrameTime& when, const ParamSet& params, int samples);

  // In order of construction, because members are destroyed in reverse order.
  const cli::SceneOptions& options_;
  const PreparedScene* prepared_;
  std::unique_ptr<gl::Context> context_;
  RenderDevice device_;
  std::unique_ptr<scene::GpuScene> scene_;
  render::Renderer renderer_;
  render::Setup setup_;
  std::optional<double> drawn_time_;  // of the last frame
  bool mask_details_ = false;
  std::vector<std::string> averaged_aovs_;
};

}  // namespace penumbra::session

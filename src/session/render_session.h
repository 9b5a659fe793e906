#pragma once

#include <memory>
#include <optional>

#include "cli/options.h"
#include "gl/context.h"
#include "gl/pass.h"
#include "render/renderer.h"
#include "scene/gpu_scene.h"
#include "session/prepared_scene.h"

namespace penumbra::session {

// What a session draws with.
struct SessionResources {
  gl::ShaderFiles shaders;
  shadow::Registry techniques;
  bool timed = false;  // each pass is, by the means that fits the device
};

// A context and all that draws a scene in it. Members are in the order of their making: what is made last goes first.
class RenderSession {
 public:
  RenderSession(const cli::SceneOptions& options, std::unique_ptr<gl::Context> context, const PreparedScene& prepared,
                SessionResources resources);

  // Draws frame `frame`, with the motion since the frame before it. What techniques remember goes on if that one was
  // the last drawn and no animation jumps in between.
  void draw(int frame, const ParamSet& params);
  // Draws the last frame once more, while time stands still: what a technique with memory costs when it goes on.
  void redraw(const ParamSet& params);

  // The next frame takes up nothing of the last: it is that of a run which starts there. For shaders that changed.
  void cut() { drawn_time_.reset(); }
  // Draws another scene from now on, with the same context and programs; a cut. The caller keeps it. Throws Error; then
  // the old one stays.
  void show(const PreparedScene& prepared);

  // Camera and sun of the last frame.
  const render::Setup& setup() const { return setup_; }
  const render::Renderer& renderer() const { return renderer_; }
  gl::Device& device() { return device_; }
  const gl::Context& context() const { return *context_; }
  const gl::DeviceInfo& device_info() const { return device_info_; }

 private:
  void draw_at(double time, double last_time, const render::Camera& last_camera, bool cut, const ParamSet& params);

  const cli::SceneOptions& options_;
  const PreparedScene* prepared_;
  std::unique_ptr<gl::Context> context_;
  gl::DeviceInfo device_info_;
  gl::Device device_;
  std::unique_ptr<scene::GpuScene> scene_;
  render::Renderer renderer_;
  render::Setup setup_;
  std::optional<double> drawn_time_;  // of the last frame
};

// Whether every step is checked for GL errors: --debug, or PENUMBRA_DEBUG=1.
bool debug_wanted(const cli::DeviceOptions& options);

// How passes are timed there.
gl::Timers::Mode timing_of(const gl::DeviceInfo& device);

// Holds the software rasteriser of contexts opened later to --threads. It sets the environment, which other threads may
// be reading: call it before there are any.
void limit_threads(const cli::DeviceOptions& options);

// The context that the options ask for, current. Throws Error, also where it can't draw a picture of their size.
std::unique_ptr<gl::Context> open_context(const cli::DeviceOptions& options, const cli::SceneOptions& scene);

}  // namespace penumbra::session

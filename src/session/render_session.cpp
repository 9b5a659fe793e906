#include "session/render_session.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "cli/resources.h"
#include "gl/api.h"
#include "scene/animation.h"

namespace penumbra::session {

gl::Timers::Mode timing_of(const gl::DeviceInfo& device) {
  return device.software ? gl::Timers::Mode::finish : gl::Timers::Mode::query;
}

bool debug_wanted(const cli::DeviceOptions& options) {
  const char* value = std::getenv("PENUMBRA_DEBUG");
  return options.debug || (value != nullptr && std::string_view(value) == "1");
}

void limit_threads(const cli::DeviceOptions& options) {
  // Mesa reads it when the rasteriser starts.
  if (options.threads) setenv("LP_NUM_THREADS", std::to_string(*options.threads).c_str(), /* overwrite= */ 1);
}

std::unique_ptr<gl::Context> open_context(const cli::DeviceOptions& options, const cli::SceneOptions& scene) {
  cli::check_resources(options.threads.value_or(0));
  gl::ContextOptions wanted;
  wanted.debug = wanted.debug || debug_wanted(options);
  wanted.egl_device = options.egl_device;
  wanted.width = scene.size.width;
  wanted.height = scene.size.height;
  wanted.visible = false;
  std::unique_ptr<gl::Context> context = gl::make_context(options.egl_device ? "egl" : options.backend, wanted);
  GLint most = 0;
  gl::glGetIntegerv(GL_MAX_TEXTURE_SIZE, &most);
  const int side = std::max(scene.size.width, scene.size.height) * scene.supersample;
  if (side > most) fail("a picture {} pixels long is over this driver's limit of {}", side, most);
  return context;
}

RenderSession::RenderSession(const cli::SceneOptions& options, std::unique_ptr<gl::Context> context,
                             const PreparedScene& prepared, SessionResources resources)
    : options_(options),
      prepared_(&prepared),
      context_(std::move(context)),
      device_info_(gl::device_info()),
      device_(std::move(resources.shaders), resources.timed ? timing_of(device_info_) : gl::Timers::Mode::off),
      scene_(std::make_unique<scene::GpuScene>(device_, prepared.scene)),
      renderer_(device_, std::move(resources.techniques)) {}

void RenderSession::show(const PreparedScene& prepared) {
  scene_ = std::make_unique<scene::GpuScene>(device_, prepared.scene);
  prepared_ = &prepared;
  cut();
}

void RenderSession::draw(int frame, const ParamSet& params) {
  const double time = time_of(options_, frame), last_time = time_of(options_, frame - 1);
  const bool follows = drawn_time_ == last_time;
  render::Camera last_camera = setup_.camera;
  if (drawn_time_ != time) setup_ = setup_at(*prepared_, time);
  if (!follows) last_camera = time == last_time ? setup_.camera : setup_at(*prepared_, last_time).camera;
  draw_at(time, last_time, last_camera, !follows || scene::jumps_between(prepared_->scene, last_time, time), params);
}

void RenderSession::redraw(const ParamSet& params) {
  draw_at(*drawn_time_, *drawn_time_, setup_.camera, /* cut= */ false, params);
}

void RenderSession::draw_at(double time, double last_time, const render::Camera& last_camera, bool cut,
                            const ParamSet& params) {
  drawn_time_ = time;
  renderer_.draw(*scene_,
                 {.width = options_.size.width * options_.supersample,
                  .height = options_.size.height * options_.supersample,
                  .camera = setup_.camera,
                  .last_camera = last_camera,
                  .lights = {setup_.sun},
                  .time = time,
                  .last_time = last_time,
                  .cut = cut},
                 params);
}

}  // namespace penumbra::session

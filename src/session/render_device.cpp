#include "session/render_device.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <string_view>

#include "cli/resources.h"
#include "core/error.h"
#include "gl/api.h"

namespace penumbra::session {

namespace {

// A software rasteriser runs commands some time after they are submitted and has no GPU timer for them. There, each
// pass or frame is followed by glFinish() and timed with the CPU's clock.
gl::Timers::Mode timing_of(const gl::DeviceInfo& device, RenderDevice::Timed timed) {
  if (timed == RenderDevice::Timed::nothing) return gl::Timers::Mode::off;
  if (!device.software) return gl::Timers::Mode::query;
  return timed == RenderDevice::Timed::passes ? gl::Timers::Mode::finish : gl::Timers::Mode::finish_frames;
}

}  // namespace

void limit_threads(const cli::DeviceOptions& options) {
  // Mesa reads it when the rasteriser starts.
  if (options.threads) setenv("LP_NUM_THREADS", std::to_string(*options.threads).c_str(), /* overwrite= */ 1);
}

bool debug_wanted(const cli::DeviceOptions& options) {
  const char* value = std::getenv("PENUMBRA_DEBUG");
  return options.debug || (value != nullptr && std::string_view(value) == "1");
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

RenderDevice::RenderDevice(const cli::DeviceOptions& options, Timed timed)
    : info(gl::device_info()), device(gl::ShaderFiles(options.glsl), timing_of(info, timed)) {}

}  // namespace penumbra::session

#pragma once

#include <memory>

#include "cli/options.h"
#include "gl/context.h"
#include "gl/pass.h"

namespace penumbra::session {

// Limits the software rasteriser of contexts that are opened later to --threads. Call it before any thread is started:
// it sets an environment variable, and other threads may read the environment at the same time.
void limit_threads(const cli::DeviceOptions& options);

// Whether GL errors are checked after every step: --debug, or PENUMBRA_DEBUG=1.
bool debug_wanted(const cli::DeviceOptions& options);

// Opens the context that the options ask for, and makes it current. Throws Error, also if it can't draw a picture of
// the size in the scene options.
std::unique_ptr<gl::Context> open_context(const cli::DeviceOptions& options, const cli::SceneOptions& scene);

// The current context as every command that draws uses it: its properties, the shaders (files of --glsl replace
// built-in ones of the same name), and timers in the mode that measures correctly on this driver.
struct RenderDevice {
  // On a software rasteriser each pass that is timed costs a glFinish(), and each frame where only frames are. On a
  // GPU, which does not wait for its timers, passes are timed with frames.
  enum class Timed { nothing, frames, passes };
  explicit RenderDevice(const cli::DeviceOptions& options, Timed timed = Timed::passes);

  gl::DeviceInfo info;
  gl::Device device;
};

}  // namespace penumbra::session

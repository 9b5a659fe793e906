#pragma once

#include <memory>

#include "cli/options.h"
#include "gl/context.h"
#include "gl/pass.h"

namespace penumbra::session {

// Holds the software rasteriser of contexts opened later to --threads. It sets the environment, which other threads may
// be reading: call it before there are any.
void limit_threads(const cli::DeviceOptions& options);

// Whether every step is checked for GL errors: --debug, or PENUMBRA_DEBUG=1.
bool debug_wanted(const cli::DeviceOptions& options);

// Opens the context that the options ask for, and makes it current. Throws Error, also where it can't draw a picture of
// the scene options' size.
std::unique_ptr<gl::Context> open_context(const cli::DeviceOptions& options, const cli::SceneOptions& scene);

// The current context as every command that draws uses it: its properties, the shaders (those of --glsl before the
// built-in ones), and timers of the kind that gives true times there.
struct RenderDevice {
  // `timed` false: no pass is timed, which on a software rasteriser saves a finish for each.
  explicit RenderDevice(const cli::DeviceOptions& options, bool timed = true);

  gl::DeviceInfo info;
  gl::Device device;
};

}  // namespace penumbra::session

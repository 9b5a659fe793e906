#pragma once

#include <string>
#include <vector>

#include "io/report.h"

namespace penumbra::app {

// Tries one backend in a child process, so that a driver that crashes or hangs is reported and does not end the
// program. Returns {"name", "works", "device": io::to_json(DeviceInfo)} or {"name", "works", "fault"}.
io::Json probe_backend(const std::string& name);

// gl::egl_devices() from a child process.
std::vector<std::string> probe_egl_devices();

}  // namespace penumbra::app

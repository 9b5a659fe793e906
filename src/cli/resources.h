#pragma once

#include <string>

namespace penumbra::cli {

// OpenGL drivers crash or hang if they get too little memory or too few threads. Call this before a driver is loaded:
// it throws Error if this process's limits leave less address space (ulimit -v) than the smallest picture takes, or
// fewer threads (ulimit -u, or a container's limit) than a software rasteriser starts. `threads` is the number that the
// rasteriser may use; 0 means one per core.
void check_resources(int threads);

// Why memory or a thread was refused, as one sentence that names the limit in force.
std::string memory_refused();
std::string threads_refused();

}  // namespace penumbra::cli

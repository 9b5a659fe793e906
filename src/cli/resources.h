#pragma once

#include <string>

namespace penumbra::cli {

// OpenGL drivers crash or hang where they get too little memory or too few threads. Throws Error, before one is asked
// for anything, when this process's limits leave less address space (ulimit -v) than the smallest picture takes, or
// fewer threads (ulimit -u, a container's limit) than a software rasteriser starts. `threads` are those that the
// rasteriser may use; 0: one a core.
void check_resources(int threads);

// Why memory or a thread was refused, as one sentence that names the limit in force.
std::string memory_refused();
std::string threads_refused();

}  // namespace penumbra::cli

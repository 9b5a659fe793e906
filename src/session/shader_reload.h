#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "gl/shader_library.h"

namespace penumbra::session {

// The result of compiling changed shaders.
struct ShaderReload {
  std::vector<std::filesystem::path> files;  // the changed files of the overlay folder
  std::size_t rebuilt = 0, failed = 0;       // programs
  double seconds = 0;                        // to compile both
  std::vector<std::string> errors;           // shader_faults() now; empty if there are none

  // Whether the next frame can differ from the last.
  bool redraws() const { return rebuilt > 0; }
};

// The messages of all programs whose current source does not compile, so that their last good version is in use: a
// heading, then lines "file:line: fault" with the source line below. If several programs fail with the same lines, only
// the first is listed.
std::vector<std::string> shader_faults(const gl::ShaderLibrary& library);

// Recompiles the programs that use the files which a FileWatch on the library's overlay folder has returned. Such a
// file was written, created (it then replaces the built-in one) or deleted (the built-in one is used again). Files
// outside of the folder are ignored. The context must be current. Faults in shaders are returned and never thrown.
//
// The caller must draw the next frame without history, because the history came from other shaders. If a program is
// used for the first time while its file has a fault, the draw throws Error; it works again once the file is fixed.
ShaderReload reload_shaders(gl::ShaderLibrary& library, std::span<const std::filesystem::path> changed);

}  // namespace penumbra::session

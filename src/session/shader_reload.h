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

// Messages of all programs that draw with their last good version, whenever they failed: a heading, then lines
// "file:line: fault" with the file's line below. Of programs that fail for the same lines the first alone.
std::vector<std::string> shader_faults(const gl::ShaderLibrary& library);

// Recompiles for the files that a FileWatch on the library's overlay folder has returned: written, created (they hide
// the built-in ones) or deleted (the built-in ones are back). Programs that are made of them are compiled now. Files
// elsewhere are ignored. The context is current. Never throws for a shader's faults.
//
// Afterwards the caller draws a cut, because histories came from other shaders. A program that is used for the first
// time while its file is broken throws Error from the draw; once the file is mended, drawing again works.
ShaderReload reload_shaders(gl::ShaderLibrary& library, std::span<const std::filesystem::path> changed);

}  // namespace penumbra::session

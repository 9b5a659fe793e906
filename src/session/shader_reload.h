#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "gl/shader_library.h"

namespace penumbra::session {

// What came of shaders that changed.
struct ShaderReload {
  std::vector<std::filesystem::path> files;  // those of the overlay, as they were told
  std::size_t rebuilt = 0, failed = 0;       // programs
  double seconds = 0;                        // to compile both
  std::vector<std::string> errors;           // shader_faults() now; empty: all is well

  // Whether the next frame is another than the last.
  bool redraws() const { return rebuilt > 0; }
};

// Messages of all programs that draw with their last good version, whenever they failed: a heading, then lines
// "file:line: fault" with the file's line below. Of programs that fail for the same lines the first alone.
std::vector<std::string> shader_faults(const gl::ShaderLibrary& library);

// Takes up what a FileWatch on the library's overlay folder told: files that were written, made (they hide the built-in
// ones) or deleted (the built-in ones are back). Programs that are made of them are compiled now. Files elsewhere are
// passed over. The context is current. Never throws for a shader's faults.
//
// After it the caller draws a cut: what techniques remember came from other shaders. A program that is needed for the
// first time while its file is broken throws Error from the draw; that goes on to work after a fix, by drawing again.
ShaderReload reload_shaders(gl::ShaderLibrary& library, std::span<const std::filesystem::path> changed);

}  // namespace penumbra::session

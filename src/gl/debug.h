#pragma once

#include <string_view>

#include "api.h"

namespace penumbra::gl {

// Labels an object for RenderDoc, apitrace and driver messages (GL_BUFFER, GL_TEXTURE, GL_PROGRAM, …).
void label(GLenum kind, GLuint id, std::string_view text);

// Installs the synchronous debug callback. Errors are remembered and thrown by check_errors().
void enable_debug_output();

// Throws Error with the first GL error or debug message of type error since the last call; called at the end of every
// Pass in a debug context, and by tests at their end.
void check_errors(std::string_view where);
bool debug_enabled();

// A debug group in a scope.
class DebugGroup {
 public:
  explicit DebugGroup(std::string_view name);
  ~DebugGroup();
  DebugGroup(const DebugGroup&) = delete;
  DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace penumbra::gl

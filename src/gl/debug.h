#pragma once

#include <string_view>

#include "api.h"

namespace penumbra::gl {

// Labels an object for RenderDoc, apitrace and driver messages (GL_BUFFER, GL_TEXTURE, GL_PROGRAM, …).
void label(GLenum kind, GLuint id, std::string_view text);

// Installs the synchronous debug callback in the current context. Nothing can be thrown through the driver, so an error
// is remembered with the debug group that it happened in, and check_errors() throws it.
void enable_debug_output();
// Whether the current context has the callback.
bool debug_enabled();

// Throws Error with the first GL error or debug message of type error since the last call. In a debug context, a Pass
// calls it after each step; elsewhere the frame's owner may. `where` names the place when no debug group was open.
void check_errors(std::string_view where);
// Forgets what check_errors() would throw: the error has been reported in other words.
void forget_errors();

// A debug group in a scope.
class DebugGroup {
 public:
  explicit DebugGroup(std::string_view name);
  ~DebugGroup();
  DebugGroup(const DebugGroup&) = delete;
  DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace penumbra::gl

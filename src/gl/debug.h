#pragma once

#include <string>
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
// Tells whether a call that makes storage ran out of memory, and whether nothing else is taken for that. OpenGL keeps
// an error's flag until it is read, whoever raised it, and drivers keep few flags: so those that are there before the
// call are read first. They are lost to the caller's own glGetError(), and so are logged as warnings, by name; in a
// debug context check_errors() throws them as ever.
class StorageCheck {
 public:
  // `what`: "texture 'mask'"; it must outlive the check.
  explicit StorageCheck(std::string_view what);
  // Once, after the call: whether it ran out of memory. Other errors of the call are logged or thrown likewise.
  bool ran_out();

 private:
  std::string_view what_;
  std::string earlier_;  // what check_errors() was to throw
};

// A debug group in a scope.
class DebugGroup {
 public:
  explicit DebugGroup(std::string_view name);
  ~DebugGroup();
  DebugGroup(const DebugGroup&) = delete;
  DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace penumbra::gl

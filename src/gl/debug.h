#pragma once

#include <string>
#include <string_view>

#include "api.h"

namespace penumbra::gl {

// Labels an object for RenderDoc, apitrace and driver messages (GL_BUFFER, GL_TEXTURE, GL_PROGRAM, …).
void label(GLenum kind, GLuint id, std::string_view text);

// Installs the synchronous debug callback in the current context. A callback can't throw through the driver, so it
// stores an error with the debug group that it happened in, and check_errors() throws it.
void enable_debug_output();
// Whether the current context has the callback.
bool debug_enabled();

// Throws Error with the first GL error or debug message of type error since the last call. In a debug context, a Pass
// calls it after each step; in other contexts the code that renders the frame may call it. `where` names the place when
// no debug group was open.
void check_errors(std::string_view where);
// Tells whether a call that allocates storage ran out of memory. OpenGL keeps an error flag until it is read, and
// drivers keep few of them, so a flag raised by an earlier call, perhaps the caller's, would hide this one's. The
// constructor therefore reads all flags that are set. The caller's own glGetError() will not see those any more, so
// they are logged as warnings, by name; in a debug context check_errors() throws them as usual.
class StorageCheck {
 public:
  // `what`: "texture 'mask'"; it must outlive the check.
  explicit StorageCheck(std::string_view what);
  // To be called once, after the allocation. Other errors of the allocation are logged or thrown in the same way.
  bool ran_out();

 private:
  std::string_view what_;
  std::string earlier_;  // an earlier error's message, for check_errors() to throw
};

// Whether conditional rendering of the caller's is active, by which the driver may leave out draws, clears and
// dispatches. OpenGL can't be asked for it, but refuses to begin another one. So the error flags are read, as
// StorageCheck does; `what` is what its warnings call the check.
bool conditional_rendering_is_active(std::string_view what);

// Opens a debug group and closes it at the end of the scope.
class DebugGroup {
 public:
  explicit DebugGroup(std::string_view name);
  ~DebugGroup();
  DebugGroup(const DebugGroup&) = delete;
  DebugGroup& operator=(const DebugGroup&) = delete;
};

}  // namespace penumbra::gl

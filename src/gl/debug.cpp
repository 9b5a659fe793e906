#include "debug.h"

#include <mutex>
#include <string>
#include <vector>

#include "../core/error.h"
#include "../core/log.h"

namespace penumbra::gl {
namespace {

thread_local std::vector<std::string> open_groups;

// The first error since the last check.
struct Pending {
  std::mutex mutex;
  std::string message;
};

Pending& pending() {
  static Pending instance;
  return instance;
}

std::string here(std::string_view otherwise) {
  return open_groups.empty() ? std::string(otherwise) : open_groups.back();
}

std::string located(const std::string& place, std::string_view message) {
  return place.empty() ? std::string(message) : fmt::format("{}: {}", place, message);
}

void APIENTRY on_message(GLenum source, GLenum type, GLuint /*id*/, GLenum severity, GLsizei length,
                         const GLchar* message, const void* /*user*/) {
  // Program reports compilers' messages itself, in the user's file names.
  if (source == GL_DEBUG_SOURCE_SHADER_COMPILER || source == GL_DEBUG_SOURCE_APPLICATION) return;
  std::string_view text =
      length < 0 ? std::string_view(message) : std::string_view(message, static_cast<std::size_t>(length));
  while (!text.empty() && text.back() == '\n') text.remove_suffix(1);
  if (type == GL_DEBUG_TYPE_ERROR) {
    const std::lock_guard lock(pending().mutex);
    if (pending().message.empty()) pending().message = located(here(""), text);
  } else if (severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM) {
    log(LogLevel::debug, located(here(""), text));
  }
}

const char* error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
      return "GL_CONTEXT_LOST";
    default:
      return "unknown GL error";
  }
}

// Empties the driver's error flags; the first one, or GL_NO_ERROR.
GLenum take_error_flags() {
  const GLenum first = glGetError();
  for (GLenum next = first; next != GL_NO_ERROR && next != GL_CONTEXT_LOST;) next = glGetError();
  return first;
}

}  // namespace

void label(GLenum kind, GLuint id, std::string_view text) {
  static constexpr std::size_t longest = 200;  // every driver takes 256
  text = text.substr(0, longest);
  glObjectLabel(kind, id, static_cast<GLsizei>(text.size()), text.data());
}

void enable_debug_output() {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(on_message, nullptr);
  forget_errors();
}

bool debug_enabled() {
  void* callback = nullptr;
  glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback);
  return callback == reinterpret_cast<void*>(on_message);
}

void check_errors(std::string_view where) {
  std::string message;
  {
    const std::lock_guard lock(pending().mutex);
    message.swap(pending().message);
  }
  const GLenum flag = take_error_flags();
  if (message.empty() && flag != GL_NO_ERROR) message = located(here(where), error_name(flag));
  if (!message.empty()) throw Error(message);
}

void forget_errors() {
  take_error_flags();
  const std::lock_guard lock(pending().mutex);
  pending().message.clear();
}

DebugGroup::DebugGroup(std::string_view name) {
  open_groups.emplace_back(name);
  glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, static_cast<GLsizei>(name.size()), name.data());
}

DebugGroup::~DebugGroup() {
  glPopDebugGroup();
  open_groups.pop_back();
}

}  // namespace penumbra::gl

#include "debug.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "../core/error.h"
#include "../core/log.h"

namespace penumbra::gl {
namespace {

thread_local std::vector<std::string> open_groups;

// The first error since the last check. Debug output is synchronous, so it comes on the thread of the call.
thread_local std::string pending;

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
    if (pending.empty()) pending = located(here(""), text);
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

// Reads, and thereby clears, the driver's error flags. Stops at GL_CONTEXT_LOST, which a lost context returns without
// end.
std::vector<GLenum> take_error_flags() {
  std::vector<GLenum> flags;
  for (GLenum flag = glGetError(); flag != GL_NO_ERROR; flag = glGetError()) {
    flags.push_back(flag);
    if (flag == GL_CONTEXT_LOST) break;
  }
  return flags;
}

std::string take_message() { return std::exchange(pending, {}); }

void put_message(std::string message) { pending = std::move(message); }

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
  take_error_flags();
  take_message();
}

bool debug_enabled() {
  void* callback = nullptr;
  glGetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback);
  return callback == reinterpret_cast<void*>(on_message);
}

void check_errors(std::string_view where) {
  std::string message = take_message();
  const std::vector<GLenum> flags = take_error_flags();
  if (message.empty() && !flags.empty()) message = located(here(where), error_name(flags.front()));
  if (!message.empty()) throw Error(message);
}

StorageCheck::StorageCheck(std::string_view what) : what_(what) {
  const std::vector<GLenum> flags = take_error_flags();
  earlier_ = take_message();
  if (!earlier_.empty()) return;
  for (const GLenum flag : flags)
    warn("OpenGL: an earlier call raised {}, found when {} was made", error_name(flag), what_);
}

bool StorageCheck::ran_out() {
  const std::vector<GLenum> flags = take_error_flags();
  const bool out = std::ranges::find(flags, GLenum{GL_OUT_OF_MEMORY}) != flags.end();
  std::string message = take_message();  // of the call
  if (message.empty() && !out) {
    for (const GLenum flag : flags) warn("OpenGL: making {} raised {}", what_, error_name(flag));
  }
  const bool told = out || message.empty();  // running out of memory is the caller's to report
  put_message(!earlier_.empty() || told ? std::move(earlier_) : std::move(message));
  return out;
}

bool conditional_rendering_is_active(std::string_view what) {
  GLuint query = 0;
  glCreateQueries(GL_SAMPLES_PASSED, 1, &query);
  for (const GLenum flag : take_error_flags())
    warn("OpenGL: an earlier call raised {}, found by {}", error_name(flag), what);
  std::string earlier = take_message();
  glBeginConditionalRender(query, GL_QUERY_WAIT);
  const bool active = !take_error_flags().empty();
  if (!active) glEndConditionalRender();
  glDeleteQueries(1, &query);
  put_message(std::move(earlier));
  return active;
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

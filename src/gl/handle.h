#pragma once

#include <utility>

#include "api.h"

namespace penumbra::gl {

// In this scope, handles that the calling thread destroys forget their objects instead of deleting them: for what was
// made in a context that is lost or not current. Else OpenGL would delete the objects that have the same names in the
// context that is current.
class LostContext {
 public:
  LostContext() : outer_(std::exchange(active_, true)) {}
  ~LostContext() { active_ = outer_; }
  LostContext(const LostContext&) = delete;
  LostContext& operator=(const LostContext&) = delete;

  static bool is_active() { return active_; }

 private:
  inline static thread_local bool active_ = false;
  bool outer_;
};

// One GL object name; move-only. If owned, the destructor calls Deleter, a function that deletes one name; if not, the
// object belongs to other code and is not deleted.
template <void (*Deleter)(GLuint)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint id, bool owned = true) : id_(id), owned_(owned) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)), owned_(other.owned_) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, 0);
      owned_ = other.owned_;
    }
    return *this;
  }
  ~Handle() { reset(); }

  GLuint id() const { return id_; }
  bool is_owned() const { return owned_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  void reset() {
    const GLuint id = std::exchange(id_, 0);
    if (id != 0 && owned_ && !LostContext::is_active()) Deleter(id);
  }
  GLuint id_ = 0;
  bool owned_ = true;
};

}  // namespace penumbra::gl

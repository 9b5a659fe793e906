#pragma once

#include <utility>

#include "api.h"

namespace penumbra::gl {

// Owns one GL object name; move-only. Deleter is a function that deletes one name.
template <void (*Deleter)(GLuint)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint id) : id_(id) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    if (this != &other) {
      reset();
      id_ = std::exchange(other.id_, 0);
    }
    return *this;
  }
  ~Handle() { reset(); }

  GLuint id() const { return id_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  void reset() {
    if (id_ != 0) Deleter(std::exchange(id_, 0));
  }
  GLuint id_ = 0;
};

}  // namespace penumbra::gl

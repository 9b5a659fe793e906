#pragma once

#include <glm/glm.hpp>

namespace penumbra::viewer {

// A mouse button that went down over the picture. A hand trembles while it clicks, and on a slow machine the pointer
// is far away before the next frame: so nothing moves until a frame sees the pointer some pixels away from where the
// button went down, and then only by what the pointer moves from there on.
class Drag {
 public:
  static constexpr float threshold = 4;  // pixels

  void press(const glm::vec2& pointer);
  void release() { state_ = State::none; }
  // Takes where the pointer is now, and returns by how much it dragged since the last call.
  glm::vec2 move(const glm::vec2& pointer);

 private:
  enum class State { none, pressed, drags };
  State state_ = State::none;
  glm::vec2 last_{0};  // where the button went down, then where the pointer was last
};

}  // namespace penumbra::viewer

#include "viewer/drag.h"

#include <utility>

namespace penumbra::viewer {

void Drag::press(const glm::vec2& pointer) {
  state_ = State::pressed;
  last_ = pointer;
}

glm::vec2 Drag::move(const glm::vec2& pointer) {
  if (state_ == State::drags) return pointer - std::exchange(last_, pointer);
  if (state_ == State::pressed && glm::distance(pointer, last_) > threshold) {
    state_ = State::drags;
    last_ = pointer;
  }
  return glm::vec2(0);
}

}  // namespace penumbra::viewer

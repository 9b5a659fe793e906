#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "viewer/panels.h"
#include "viewer/present.h"

namespace penumbra::viewer {

// Where the picture stands in the window, and the hand that is over it.
struct PictureArea {
  glm::vec2 corner{0}, size{1};     // of the window, from its upper left
  std::optional<glm::vec2> cursor;  // over the picture, from its upper left
  bool busy = false;                // a button that began over the picture is down
};

// Draws the texture that is seen into what is left of the current window, and takes the mouse over it: the camera, the
// sun, the line between A and B, the magnification.
PictureArea picture_area(const Panel& panel, const gl::Texture* seen);

// The keys that are for the picture and the viewer as a whole, where no field has them.
void take_keys(const Panel& panel, float seconds);

}  // namespace penumbra::viewer

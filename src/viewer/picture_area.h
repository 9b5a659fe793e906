#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "viewer/panels.h"
#include "viewer/present.h"

namespace penumbra::viewer {

// Where the picture is in the window, and what the mouse does over it.
struct PictureArea {
  glm::vec2 corner{0}, size{1};     // of the window, from its upper left
  std::optional<glm::vec2> cursor;  // over the picture, from its upper left
  bool dragging = false;            // a mouse button that was pressed over the picture is down
  glm::vec2 dragged{0};             // what it drags in this frame, pixels
};

// Draws the texture `shown` into the rest of the current ImGui window, and handles the mouse over it: it moves the
// camera, the sun, the user's lamps and the line between A and B, and magnifies.
PictureArea picture_area(const Panel& panel, const gl::Texture* shown);

// Handles the keys that act on the picture and the viewer as a whole, unless the user types into a field.
void take_keys(const Panel& panel, float seconds);

}  // namespace penumbra::viewer

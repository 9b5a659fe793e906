#pragma once

#include "viewer/picture_area.h"

namespace penumbra::viewer {

// Rings at the lamps that shine, drawn over the picture, by which the left button drags them parallel to it. Not where
// the picture is magnified or beside another one.

// Returns whether the mouse drags a ring. `active`: a button that was pressed over the picture is down.
bool drag_lamp(const Panel& panel, const PictureArea& area, bool active);
void draw_lamp_rings(const Panel& panel, const PictureArea& area);

}  // namespace penumbra::viewer

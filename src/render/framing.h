#pragma once

#include "render/view.h"
#include "scene/pose.h"

namespace penumbra::render {

// A three-quarter view from a little above, as near as the box's corners allow: they reach to 5 % from the picture's
// edge. `aspect` is the picture's width / height.
Camera framing_camera(const scene::Bounds& bounds, float aspect);

// Whether a camera shows the scene: it is within the box, or the box fills at least a tenth of the picture's width or
// height.
bool sees(const Camera& camera, float aspect, const scene::Bounds& bounds);

}  // namespace penumbra::render

#pragma once

#include "render/view.h"
#include "scene/pose.h"

namespace penumbra::render {

// A three-quarter view from slightly above, as close as possible while the box's corners keep a margin of 5 % to the
// picture's edge. `aspect` is the picture's width / height.
Camera framing_camera(const scene::Bounds& bounds, float aspect);

// Whether a camera shows the scene: it stands inside the box, or the box is at least a tenth as wide or as high as the
// picture.
bool sees(const Camera& camera, float aspect, const scene::Bounds& bounds);

}  // namespace penumbra::render

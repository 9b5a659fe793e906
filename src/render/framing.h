#pragma once

#include <vector>

#include "render/view.h"
#include "scene/pose.h"

namespace penumbra::render {

// A three-quarter view from slightly above, as close as possible while the box's corners keep a margin of 5 % to the
// picture's edge. `aspect` is the picture's width / height.
Camera framing_camera(const scene::Bounds& bounds, float aspect);

// What a placed camera shows of a scene whose bounds are `all`: without flat nodes that lie under the others and are
// many times wider than these together, such as a sea around an island. Their shadows fall on nothing, and what casts
// shadows would be too small to see. Where some are left out, there is room for shadows around the others. What is less
// than a thousandth of the scene's size is not framed by itself. `nodes`: scene::node_bounds(), without those of skies.
scene::Bounds framed_bounds(std::vector<scene::Bounds> nodes, const scene::Bounds& all);

// Whether a camera shows the scene: it stands inside the box, or the box is at least a tenth as wide or as high as the
// picture.
bool sees(const Camera& camera, float aspect, const scene::Bounds& bounds);

}  // namespace penumbra::render

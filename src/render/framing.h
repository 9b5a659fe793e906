#pragma once

#include <vector>

#include "render/view.h"
#include "scene/casting.h"
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

// The box of everything that casts shadows, for a camera that is asked to show it: without the floors below it, which
// are flat nodes that lie under the others, as for framed_bounds(), and wider than these together by any visible
// amount. The box of everything where nothing casts.
scene::Bounds caster_bounds(const scene::Scene& scene, const scene::Pose& pose, const scene::CasterChoice& choice);

// Whether a camera shows the scene: it stands inside the box, or the box is at least a tenth as wide or as high as the
// picture.
bool sees(const Camera& camera, float aspect, const scene::Bounds& bounds);

}  // namespace penumbra::render

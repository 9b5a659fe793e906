#pragma once

#include "scene/casting.h"
#include "scene/pose.h"

namespace penumbra::viewer {

// The box of everything that casts shadows, for the camera to show. Floors are left out: what is flat, lies below the
// other casters and extends beyond them on all sides. The box of everything where nothing casts.
scene::Bounds caster_bounds(const scene::Scene& scene, const scene::Pose& pose, const scene::CasterChoice& choice);

}  // namespace penumbra::viewer

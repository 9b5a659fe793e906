#pragma once

#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// The time inside an animation of `duration` at `seconds` of endless looping; an exact multiple of the duration is its
// end, not its start.
double looped_time(double seconds, double duration);

// The channel's value at a time, held before its first and after its last key; rotations have unit length.
std::vector<float> sample(const AnimationChannel& channel, double time);

// Whether an animation that pose_at plays begins again between two moments, from other values than it ended with: what
// moves then jumps. Backwards too.
bool jumps_between(const Scene& scene, double first, double second);

// The animations that pose_at plays, by index.
std::vector<std::size_t> played_animations(const Scene& scene);

}  // namespace penumbra::scene

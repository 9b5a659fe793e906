#pragma once

#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// The time within an animation of `duration` after `seconds` of endless looping. An exact multiple of the duration maps
// to the animation's end, not to its start.
double looped_time(double seconds, double duration);

// The channel's value at a time. Before the first key and after the last one their values apply; rotations have unit
// length.
std::vector<float> sample(const AnimationChannel& channel, double time);

// Whether an animation that pose_at() plays restarts between two times with values other than those it ended with, so
// that something jumps. Also for time running backwards.
bool jumps_between(const Scene& scene, double first, double second);

// The animations that pose_at plays, by index.
std::vector<std::size_t> played_animations(const Scene& scene);

}  // namespace penumbra::scene

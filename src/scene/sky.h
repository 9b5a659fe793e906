#pragma once

#include <vector>

#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::scene {

// The nodes, if any, whose meshes are skies: painted shells about all that is drawn besides, which would shadow all of
// it. A mesh is taken for one if
// - its box holds the boxes of all else, but for what lies below it;
// - seen from the middle of all else, it fills the sky from 6 degrees over the horizon to the zenith, and shows its
//   front or is double-sided;
// - and something tells it from a room: its material is unlit or only shines, its name, its mesh's or its material's
//   has "sky", "backdrop", "panorama" or "hdri" in it, or it is everywhere at least twice as far from the middle as
//   the furthest corner of all else's box.
// Skies within skies are found from the outermost inwards.
std::vector<int> find_skies(const Scene& scene, const Pose& pose);

}  // namespace penumbra::scene

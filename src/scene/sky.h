#pragma once

#include <filesystem>
#include <vector>

#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::scene {

// The nodes, if any, whose meshes are skies: shells that enclose the rest of the scene and would shadow all of it. "The
// rest" is everything else that is drawn. A mesh counts as a sky if
// - its bounding box contains that of the rest, except below;
// - seen from the centre of the rest, its front faces (or a double-sided material) cover 97 % of the directions from 6
//   degrees above the horizon to the zenith;
// - and something distinguishes it from a room: its material is unlit or only emissive; the name of the node, mesh or
//   material contains "sky", "backdrop", "panorama" or "hdri"; or it is in every direction at least twice as far from
//   that centre as the corners of the rest's bounding box.
// Nested skies are listed from the outermost inwards. Skinned and instanced meshes are never skies.
std::vector<int> find_skies(const Scene& scene, const Pose& pose);

// Warns of the scene's skies that cast no shadow only because they are skies: neither the file's extras nor
// set_casting() decides about them.
void warn_of_skies(const std::filesystem::path& file, const Scene& scene);

}  // namespace penumbra::scene

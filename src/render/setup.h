#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/view.h"
#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::render {

enum class GroundChoice { automatic, on, off };

// What the user left open is chosen from the scene.
struct SetupRequest {
  // Name or index of one of the file's. Empty: the first of them that sees the scene (within its bounds, or with the
  // bounds over a tenth of the picture's width or height), else one that frames the scene.
  std::string camera;
  GroundChoice ground = GroundChoice::automatic;
  float aspect = 16.0f / 9.0f;               // width / height of the picture
  std::optional<scene::Bounds> bounds = {};  // to frame; absent: the scene's
};

struct Setup {
  Camera camera;
  Sun sun;
  bool ground = false;  // add_ground() puts it there
  // The nodes that camera and sun sit on and whose animation they follow; none: they stand still.
  std::optional<std::size_t> camera_node, sun_node;
};

// The cameras that stand in a scene, in the order of SetupRequest's indices; none has an empty name.
std::vector<std::string> camera_names(const scene::Scene& scene);

// Throws Error, listing near names, for a camera that the file lacks.
Setup choose_setup(const scene::Scene& scene, const scene::Pose& pose, const SetupRequest& request = {});

// Camera and sun where `pose`, of the scene that they were chosen for, has their nodes.
void follow(Setup& setup, const scene::Pose& pose);

// The near plane for an eye in a scene of those bounds: close enough to cut nothing off.
float near_plane_for(const scene::Bounds& bounds, const glm::vec3& eye);

// A unit vector towards a light. Radians; azimuth from +Z towards +X, elevation over the horizon.
glm::vec3 direction_to(float azimuth, float elevation);

// Adds a grey plane under the scene, as wide as shadows and the horizon ask; part of the scene like all else.
void add_ground(scene::Scene& scene, const scene::Bounds& bounds);

}  // namespace penumbra::render

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/ground.h"
#include "render/view.h"
#include "scene/pose.h"
#include "scene/scene.h"

namespace penumbra::render {

enum class GroundChoice { automatic, on, off };

// What the user asked for; the rest is chosen from the scene.
struct SetupRequest {
  // Name or index of one of the file's cameras. Empty: the first camera that stands inside the scene's bounds, or in
  // whose picture the bounds are at least a tenth as wide or as high as the picture. If there is no such camera, one is
  // placed that shows the whole scene, or what stands on a ground that is many times wider.
  std::string camera;
  GroundChoice ground = GroundChoice::automatic;
  float aspect = 16.0f / 9.0f;               // width / height of the picture
  std::optional<scene::Bounds> bounds = {};  // the bounds to frame; absent: those of the scene
  // Names or indices of the file's lights that shine; absent: all that are not 0. `no_sun`: no directional light does.
  std::optional<std::vector<std::string>> lights = {};
  bool no_sun = false;
  bool own_sun = false;                   // the user places a sun: it shines whatever the file has
  std::optional<float> lamp_radius = {};  // of the file's spots and point lights, metres
  std::vector<LampLight> lamps = {};      // besides those of the file
};

// A light besides the first sun. Those of the file follow a node.
struct PlacedLight {
  std::string name;
  FrameLight light;
  std::optional<std::size_t> node;
};

struct Setup {
  Camera camera;
  SunLight sun;
  std::string sun_name = "sun";
  bool sun_shines = true;  // false: only `lights` light the scene
  std::vector<PlacedLight> lights = {};
  bool ground = false;     // the scene has no floor; add_ground() adds one
  bool on_ground = false;  // it has a floor, or gets one
  // Albedo of the ground around the scene, to the horizon: that of the floor.
  glm::vec3 ground_color{ground_albedo};
  // The nodes that camera and sun are attached to, whose animation they follow. Absent: they do not move.
  std::optional<std::size_t> camera_node, sun_node;
};

// All lights that shine, the sun first. At least one.
std::vector<FrameLight> frame_lights(const Setup& setup);

// Those of them that cast shadows: the first ones.
std::vector<FrameLight> shadowed_lights(const Setup& setup);

// Of each light that shines, for FrameInputs::light_ids: the same whichever other lights shine. Setup::sun is 0.
std::vector<int> light_ids(const Setup& setup);

// Of each light that shines, in the same order.
std::vector<std::string> shining_names(const Setup& setup);

// The names of the lights that cast shadows, in the same order.
std::vector<std::string> shadowed_names(const Setup& setup);

// The names of the lights that the scene places, in the order of SetupRequest::lights' indices. None is empty.
std::vector<std::string> light_names(const scene::Scene& scene);

// Their nodes, in the same order.
std::vector<std::size_t> light_nodes(const scene::Scene& scene);

// The names of the cameras that the scene places, in the order of SetupRequest's indices. None is empty.
std::vector<std::string> camera_names(const scene::Scene& scene);

// Which of these lights or cameras a text of SetupRequest means: the first of that name, or the one of that index, as
// "2" or "#2". Nothing: none of them.
std::optional<std::size_t> index_of_text(const std::vector<std::string>& names, std::string_view text);

// A text that means the one of that index whatever its name: "2", or "#2" where another one has the name "2".
std::string text_of_index(const std::vector<std::string>& names, std::size_t index);

// A file that has lights is lit by these and the user's lamps; where there are neither, a sun suits the camera. Throws
// Error, which lists similar names, for a camera or a light that the file lacks, and if nothing is left to light the
// scene. Warns of lights that are too many for a frame, or to cast shadows.
Setup choose_setup(const scene::Scene& scene, const scene::Pose& pose, const SetupRequest& request = {});

// Moves camera and lights to where `pose` puts their nodes. `pose` must be of the scene that they were chosen for.
void follow(Setup& setup, const scene::Pose& pose);

// The distance of the near plane for an eye in a scene of those bounds, metres: small enough to clip nothing visible.
float near_plane_for(const scene::Bounds& bounds, const glm::vec3& eye);

// A unit vector towards a light. Angles in radians: azimuth from +Z towards +X, elevation above the horizon.
glm::vec3 direction_to(float azimuth, float elevation);

// Adds a grey plane under the scene, large enough to receive its shadows and to reach towards the horizon. It becomes
// an ordinary part of the scene.
void add_ground(scene::Scene& scene, const scene::Bounds& bounds);

}  // namespace penumbra::render

#include "render/setup.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/error.h"
#include "core/names.h"
#include "render/framing.h"
#include "render/ground.h"

namespace penumbra::render {

namespace {

// A camera of the file and the world matrix that places it.
struct PlacedCamera {
  std::string name;
  const scene::Camera* camera;
  std::size_t node;
};

std::vector<PlacedCamera> placed_cameras(const scene::Scene& scene, const scene::Pose& pose) {
  std::vector<PlacedCamera> placed;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const scene::Node& node = scene.nodes[i];
    if (node.camera < 0 || !pose.drawn[i]) continue;
    const scene::Camera& camera = scene.cameras[static_cast<std::size_t>(node.camera)];
    std::string name = !camera.name.empty() ? camera.name : node.name;
    if (name.empty()) name = std::to_string(placed.size());
    placed.push_back({std::move(name), &camera, i});
  }
  return placed;
}

// The rigid part of a node's matrix: a camera's own scale does not matter.
glm::mat4 view_of(const glm::mat4& world) {
  const glm::vec3 eye(world[3]);
  glm::vec3 back(world[2]), up(world[1]);
  if (!(glm::length(back) > 0)) back = {0, 0, 1};
  if (!(glm::length(glm::cross(up, back)) > 0))
    up = std::abs(back.y) < 0.9f * glm::length(back) ? glm::vec3(0, 1, 0) : glm::vec3(0, 0, 1);
  return glm::lookAt(eye, eye - glm::normalize(back), glm::normalize(up));
}

// The camera's projection; follow() sets its position.
Camera camera_of(const PlacedCamera& placed) {
  const scene::Camera& file = *placed.camera;
  Camera camera{
      .orthographic = file.orthographic, .fov_y = file.fov_y, .half_height = file.half_height, .near = file.near};
  if (file.far) camera.far = *file.far;
  return camera;
}

const PlacedCamera& find_camera(const std::vector<PlacedCamera>& placed, const std::string& wanted) {
  for (const PlacedCamera& camera : placed) {
    if (camera.name == wanted) return camera;
  }
  std::size_t index = 0;
  const char* end = wanted.data() + wanted.size();
  const auto parsed = std::from_chars(wanted.data(), end, index);
  if (parsed.ec == std::errc() && parsed.ptr == end && index < placed.size()) return placed[index];
  if (placed.empty()) fail("no camera '{}': the scene has no cameras", wanted);
  std::vector<std::string> names;
  for (const PlacedCamera& camera : placed) names.push_back(camera.name);
  constexpr std::size_t most_listed = 20;
  if (names.size() > most_listed && near_names(wanted, names).empty())
    fail("no camera '{}': the scene has {}, none of a name near it", wanted, names.size());
  fail_unknown("camera", wanted, names);
}

// The requested camera, else the first that sees the scene, else null.
const PlacedCamera* choose_camera(const std::vector<PlacedCamera>& placed, const scene::Pose& pose,
                                  const scene::Bounds& bounds, const SetupRequest& request) {
  if (!request.camera.empty()) return &find_camera(placed, request.camera);
  for (const PlacedCamera& candidate : placed) {
    Camera camera = camera_of(candidate);
    camera.view = view_of(pose.world[candidate.node]);
    if (sees(camera, request.aspect, bounds)) return &candidate;
  }
  return nullptr;
}

// 45 degrees above the horizon and to one side of the camera, so that shadows fall across the picture.
SunLight default_sun(const Camera& camera) {
  const glm::vec3 back(camera.view[0][2], camera.view[1][2], camera.view[2][2]);
  const float azimuth = std::atan2(back.x, back.z) - glm::radians(55.0f);
  // Direct sunlight at noon: 100,000 lux, a little warm.
  return {.to_light = direction_to(azimuth, glm::radians(45.0f)), .illuminance = {104000.0f, 99500.0f, 93000.0f}};
}

// A unit vector towards a light that is attached to a node: it shines along its -Z. Nothing if the node's matrix is
// singular.
std::optional<glm::vec3> to_light_of(const glm::mat4& world) {
  const glm::vec3 back(world[2]);
  const float length = glm::length(back);
  return length > 0 && std::isfinite(length) ? std::optional(back / length) : std::nullopt;
}

// The node of the first directional light whose intensity is not 0.
std::optional<std::size_t> find_sun(const scene::Scene& scene, const scene::Pose& pose) {
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const int light = scene.nodes[i].light;
    if (light < 0 || !pose.drawn[i]) continue;
    const bool directional = scene.lights[static_cast<std::size_t>(light)].kind == scene::LightKind::directional;
    if (directional && to_light_of(pose.world[i])) return i;
  }
  return std::nullopt;
}

// The file's sun, else one that suits the camera.
void choose_sun(Setup& setup, const scene::Scene& scene, const scene::Pose& pose) {
  setup.sun_node = find_sun(scene, pose);
  if (!setup.sun_node) {
    setup.sun = default_sun(setup.camera);
    return;
  }
  const scene::PunctualLight& file = scene.lights[static_cast<std::size_t>(scene.nodes[*setup.sun_node].light)];
  setup.sun = {.to_light = *to_light_of(pose.world[*setup.sun_node]), .illuminance = file.color * file.intensity};
}

float distance_to(const scene::Bounds& box, const glm::vec3& point) {
  return glm::length(glm::max(glm::max(box.min - point, point - box.max), glm::vec3(0.0f)));
}

scene::Bounds usable(scene::Bounds bounds) {
  if (bounds.empty) {
    bounds.add(glm::vec3(-1));
    bounds.add(glm::vec3(1));
  }
  return bounds;
}

}  // namespace

std::vector<std::string> camera_names(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const PlacedCamera& camera : placed_cameras(scene, scene::rest_pose(scene))) names.push_back(camera.name);
  return names;
}

glm::vec3 direction_to(float azimuth, float elevation) {
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation), std::cos(azimuth) * std::cos(elevation)};
}

float near_plane_for(const scene::Bounds& bounds, const glm::vec3& eye) {
  const scene::Bounds box = usable(bounds);
  const float radius = std::max(box.radius(), 1e-6f);
  // Half the distance leaves room for wide angles; below the eye there may be a ground plane.
  const float nearest = std::min(distance_to(box, eye), std::abs(eye.y - box.min.y));
  return std::max(0.5f * nearest, 1e-3f * radius);
}

void follow(Setup& setup, const scene::Pose& pose) {
  if (setup.camera_node) setup.camera.view = view_of(pose.world[*setup.camera_node]);
  if (setup.sun_node) setup.sun.to_light = to_light_of(pose.world[*setup.sun_node]).value_or(setup.sun.to_light);
}

Setup choose_setup(const scene::Scene& scene, const scene::Pose& pose, const SetupRequest& request) {
  const scene::Bounds bounds = usable(request.bounds ? *request.bounds : scene::bounds_of(scene, pose));
  const std::vector<PlacedCamera> cameras = placed_cameras(scene, pose);
  Setup setup;
  if (const PlacedCamera* chosen = choose_camera(cameras, pose, bounds, request)) {
    setup.camera = camera_of(*chosen);
    setup.camera_node = chosen->node;
  } else {
    setup.camera = framing_camera(bounds, request.aspect);
  }
  follow(setup, pose);
  choose_sun(setup, scene, pose);
  setup.ground = request.ground == GroundChoice::on ||
                 (request.ground == GroundChoice::automatic && !has_ground(scene, pose, bounds));
  return setup;
}

}  // namespace penumbra::render

#include "render/setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "core/error.h"
#include "core/log.h"
#include "core/names.h"
#include "render/framing.h"
#include "render/ground.h"
#include "shadow/light_projection.h"

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
  // About the origin: far from it, a place has no digits for a direction.
  return glm::translate(glm::lookAt(glm::vec3(0), -glm::normalize(back), glm::normalize(up)), -eye);
}

// The camera's projection; follow() sets its position.
Camera camera_of(const PlacedCamera& placed) {
  const scene::Camera& file = *placed.camera;
  Camera camera{
      .orthographic = file.orthographic, .fov_y = file.fov_y, .half_height = file.half_height, .near = file.near};
  if (file.far) camera.far = *file.far;
  return camera;
}

std::vector<std::string> names_of(const std::vector<PlacedCamera>& placed) {
  std::vector<std::string> names;
  for (const PlacedCamera& camera : placed) names.push_back(camera.name);
  return names;
}

const PlacedCamera& find_camera(const std::vector<PlacedCamera>& placed, const std::string& wanted) {
  const std::vector<std::string> names = names_of(placed);
  if (const std::optional<std::size_t> index = index_of_text(names, wanted)) return placed[*index];
  if (placed.empty()) fail("no camera '{}': the scene has no cameras", wanted);
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

// A light of the file on a node that is drawn.
struct FileLight {
  std::string name;
  const scene::PunctualLight* light;
  std::size_t node;
};

std::vector<FileLight> file_lights(const scene::Scene& scene, const scene::Pose& pose) {
  std::vector<FileLight> found;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const scene::Node& node = scene.nodes[i];
    if (node.light < 0 || !pose.drawn[i]) continue;
    const scene::PunctualLight& light = scene.lights[static_cast<std::size_t>(node.light)];
    std::string name = !light.name.empty() ? light.name : node.name;
    if (name.empty()) name = std::to_string(found.size());
    found.push_back({std::move(name), &light, i});
  }
  return found;
}

std::vector<std::string> names_of(const std::vector<FileLight>& lights) {
  std::vector<std::string> names;
  for (const FileLight& light : lights) names.push_back(light.name);
  return names;
}

const FileLight& find_light(const std::vector<FileLight>& lights, const std::string& wanted) {
  const std::vector<std::string> names = names_of(lights);
  if (const std::optional<std::size_t> index = index_of_text(names, wanted)) return lights[*index];
  if (lights.empty()) fail("no light '{}': the scene has no lights", wanted);
  constexpr std::size_t most_listed = 20;
  if (names.size() > most_listed && near_names(wanted, names).empty())
    fail("no light '{}': the scene has {}, none of a name near it", wanted, names.size());
  fail_unknown("light", wanted, names);
}

// Those that the user chose, each once, else all.
std::vector<FileLight> wanted_lights(const std::vector<FileLight>& lights, const SetupRequest& request) {
  if (!request.lights) return lights;
  std::vector<FileLight> chosen;
  for (const std::string& name : *request.lights) {
    const FileLight& light = find_light(lights, name);
    if (std::ranges::find(chosen, light.node, &FileLight::node) == chosen.end()) chosen.push_back(light);
  }
  return chosen;
}

// Whether a light is bright, and its node says where it is. Warns of a lamp that is too far away to cast shadows.
bool shines(const FileLight& light, const scene::Pose& pose) {
  const glm::mat4& world = pose.world[light.node];
  const glm::vec3 place(world[3]);
  const bool placed = std::isfinite(place.x + place.y + place.z);
  const bool bright = light.light->intensity > 0 && light.light->color != glm::vec3(0);
  if (!bright || !placed) return false;
  const bool sun = light.light->kind == scene::LightKind::directional;
  if (!sun && glm::any(glm::greaterThan(glm::abs(place), glm::vec3(shadow::farthest_lamp)))) {
    warn("light '{}' is left out: it is more than {} km from the origin", light.name, shadow::farthest_lamp / 1000);
    return false;
  }
  return light.light->kind == scene::LightKind::point || to_light_of(world);
}

FrameLight light_of(const scene::PunctualLight& file, const std::optional<float>& radius) {
  const glm::vec3 emitted = file.color * file.intensity;
  if (file.kind == scene::LightKind::directional) return SunLight{.illuminance = emitted};
  LampLight lamp{
      .radius = radius.value_or(file.radius.value_or(LampLight().radius)), .range = file.range, .intensity = emitted};
  if (file.kind == scene::LightKind::spot) {
    lamp.axis = {0, 0, -1};
    lamp.inner_cone = file.inner_cone;
    lamp.outer_cone = std::min(file.outer_cone, glm::half_pi<float>());
  }
  return lamp;
}

void move(SunLight& sun, const glm::mat4& world) { sun.to_light = to_light_of(world).value_or(sun.to_light); }

void move(LampLight& lamp, const glm::mat4& world) {
  lamp.position = glm::vec3(world[3]);
  if (lamp.axis != glm::vec3(0)) lamp.axis = -to_light_of(world).value_or(-lamp.axis);
}

void warn_of_many(std::size_t lights) {
  if (lights > max_lights) warn("the scene has {} lights; the first {} of them light it", lights, max_lights);
  if (lights > max_shadowed_lights) warn("only the first {} of {} lights cast shadows", max_shadowed_lights, lights);
}

const char* why_dark(const SetupRequest& request) {
  if (request.lights && request.lights->empty()) return "none of its lights is chosen";
  if (request.no_sun) return "no other light than a sun shines";
  return "its lights, or those of them that were chosen, are dark or too far away";
}

// The lights of the file and of the user, else a sun that suits the camera.
void choose_lights(Setup& setup, const scene::Scene& scene, const scene::Pose& pose, const SetupRequest& request) {
  bool lit = false;
  for (FileLight& light : wanted_lights(file_lights(scene, pose), request)) {
    if (!shines(light, pose)) continue;
    lit = true;
    const bool sun = light.light->kind == scene::LightKind::directional;
    if (sun && request.no_sun) continue;
    FrameLight shining = light_of(*light.light, request.lamp_radius);
    if (sun && !setup.sun_node) {
      setup.sun = std::get<SunLight>(shining);
      setup.sun_node = light.node;
      setup.sun_name = light.name;
    } else {
      setup.lights.push_back({std::move(light.name), shining, light.node});
    }
  }
  for (const LampLight& lamp : request.lamps) {
    lit = true;
    setup.lights.push_back({fmt::format("lamp {}", lamp.number), lamp, std::nullopt});
  }
  if (!setup.sun_node) {
    setup.sun = default_sun(setup.camera);
    setup.sun_shines = request.own_sun || !(lit || request.no_sun || request.lights);
  }
  const std::size_t shining = setup.lights.size() + (setup.sun_shines ? 1 : 0);
  if (shining == 0) fail("nothing lights the scene: {}", why_dark(request));
  warn_of_many(shining);
  setup.lights.resize(std::min<std::size_t>(setup.lights.size(), max_lights - (setup.sun_shines ? 1 : 0)));
  follow(setup, pose);
}

float distance_to(const scene::Bounds& box, const glm::vec3& point) {
  return glm::length(glm::max(glm::max(box.min - point, point - box.max), glm::vec3(0.0f)));
}

std::vector<scene::Bounds> bounds_below_sky(const scene::Scene& scene, const scene::Pose& pose) {
  std::vector<scene::Bounds> nodes = scene::node_bounds(scene, pose);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (scene.nodes[i].sky) nodes[i] = {};
  }
  return nodes;
}

scene::Bounds usable(scene::Bounds bounds) {
  if (bounds.empty) {
    bounds.add(glm::vec3(-1));
    bounds.add(glm::vec3(1));
  }
  return bounds;
}

}  // namespace

std::vector<FrameLight> frame_lights(const Setup& setup) {
  std::vector<FrameLight> lights;
  if (setup.sun_shines) lights.emplace_back(setup.sun);
  for (const PlacedLight& light : setup.lights) lights.push_back(light.light);
  return lights;
}

std::vector<FrameLight> shadowed_lights(const Setup& setup) {
  std::vector<FrameLight> lights = frame_lights(setup);
  lights.resize(std::min<std::size_t>(lights.size(), max_shadowed_lights));
  return lights;
}

std::vector<std::string> shining_names(const Setup& setup) {
  std::vector<std::string> names;
  if (setup.sun_shines) names.push_back(setup.sun_name);
  for (const PlacedLight& light : setup.lights) names.push_back(light.name);
  return names;
}

std::vector<std::string> shadowed_names(const Setup& setup) {
  std::vector<std::string> names = shining_names(setup);
  names.resize(std::min<std::size_t>(names.size(), max_shadowed_lights));
  return names;
}

std::vector<int> light_ids(const Setup& setup) {
  const auto of_node = [](std::size_t node) { return 1 + 2 * static_cast<int>(node); };
  std::vector<int> ids;
  if (setup.sun_shines) ids.push_back(0);
  for (const PlacedLight& light : setup.lights)
    ids.push_back(light.node ? of_node(*light.node) : 2 + 2 * std::get<LampLight>(light.light).number);
  return ids;
}

std::vector<std::string> light_names(const scene::Scene& scene) {
  return names_of(file_lights(scene, scene::rest_pose(scene)));
}

std::vector<std::size_t> light_nodes(const scene::Scene& scene) {
  std::vector<std::size_t> nodes;
  for (const FileLight& light : file_lights(scene, scene::rest_pose(scene))) nodes.push_back(light.node);
  return nodes;
}

std::vector<std::string> camera_names(const scene::Scene& scene) {
  return names_of(placed_cameras(scene, scene::rest_pose(scene)));
}

std::optional<std::size_t> index_of_text(const std::vector<std::string>& names, std::string_view text) {
  if (const auto named = std::ranges::find(names, text); named != names.end())
    return static_cast<std::size_t>(named - names.begin());
  text.remove_prefix(std::min(text.find_first_not_of('#'), text.size()));
  std::size_t index = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, index);
  if (parsed.ec != std::errc() || parsed.ptr != end || index >= names.size()) return {};
  return index;
}

std::string text_of_index(const std::vector<std::string>& names, std::size_t index) {
  std::string text = std::to_string(index);
  while (index_of_text(names, text) != index) text.insert(0, "#");
  return text;
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
  if (setup.sun_node) move(setup.sun, pose.world[*setup.sun_node]);
  for (PlacedLight& light : setup.lights) {
    if (light.node) std::visit([&](auto& kind) { move(kind, pose.world[*light.node]); }, light.light);
  }
}

Setup choose_setup(const scene::Scene& scene, const scene::Pose& pose, const SetupRequest& request) {
  const scene::Bounds bounds = usable(request.bounds ? *request.bounds : scene::bounds_of(scene, pose));
  const std::vector<PlacedCamera> cameras = placed_cameras(scene, pose);
  Setup setup;
  if (const PlacedCamera* chosen = choose_camera(cameras, pose, bounds, request)) {
    setup.camera = camera_of(*chosen);
    setup.camera_node = chosen->node;
  } else {
    setup.camera = framing_camera(framed_bounds(bounds_below_sky(scene, pose), bounds), request.aspect);
    setup.camera.near = near_plane_for(bounds, position_of(setup.camera));
  }
  follow(setup, pose);
  choose_lights(setup, scene, pose, request);
  const Floor floor = find_floor(scene, pose, bounds);
  setup.ground = request.ground == GroundChoice::on || (request.ground == GroundChoice::automatic && !floor.wide);
  setup.on_ground = setup.ground || floor.wide;
  if (floor.wide && !setup.ground) setup.ground_color = floor.albedo;
  return setup;
}

}  // namespace penumbra::render

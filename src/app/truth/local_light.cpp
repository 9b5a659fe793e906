#include "app/truth/local_light.h"

#include <charconv>
#include <vector>

#include "core/error.h"
#include "core/names.h"
#include "scene/pose.h"

namespace penumbra::app {

namespace {

std::size_t find_light(const scene::Scene& scene, const std::string& name) {
  std::size_t index = 0;
  const auto parsed = std::from_chars(name.data(), name.data() + name.size(), index);
  if (parsed.ec == std::errc() && parsed.ptr == name.data() + name.size() && index < scene.lights.size()) return index;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (scene.lights[i].name == name) return i;
    names.push_back(scene.lights[i].name.empty() ? std::to_string(i) : scene.lights[i].name);
  }
  if (names.empty()) fail("--light {}: the scene has no lights", name);
  fail_unknown("light", name, names);
}

// The drawn node that the light is on.
std::size_t node_of(const scene::Scene& scene, std::size_t light, const std::string& name) {
  const scene::Pose rest = scene::rest_pose(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (rest.drawn[i] && scene.nodes[i].light == static_cast<int>(light)) return i;
  }
  fail("--light {}: no node of the scene has it", name);
}

}  // namespace

std::function<truth::LocalLight(double)> local_light(const scene::Scene& scene, const std::string& name,
                                                     double radius) {
  const std::size_t light = find_light(scene, name);
  const scene::LightKind kind = scene.lights[light].kind;
  if (kind == scene::LightKind::directional) fail("--light {}: it is directional, as the sun is; see --sun", name);
  const std::size_t node = node_of(scene, light, name);
  return [&scene, node, radius, spot = kind == scene::LightKind::spot](double seconds) {
    const glm::dmat4 world(scene::pose_at(scene, seconds).world[node]);
    truth::LocalLight placed{.position = glm::dvec3(world[3]), .radius = radius};
    if (spot) placed.axis = -glm::dvec3(world[2]);
    return placed;
  };
}

}  // namespace penumbra::app

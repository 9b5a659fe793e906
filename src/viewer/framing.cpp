#include "viewer/framing.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace penumbra::viewer {

namespace {

using scene::Bounds;

constexpr float flat = 0.05f;  // largest height of a floor, as a share of its longer side
constexpr float low = 0.1f;    // of the other casters' height: a floor lies no higher
constexpr float wider = 1.2f;  // least area of a floor, as a multiple of that below the other casters

bool casts(const scene::Scene& scene, const scene::Node& node, const scene::CasterChoice& choice) {
  if (node.mesh < 0) return false;
  const auto& primitives = scene.meshes[static_cast<std::size_t>(node.mesh)].primitives;
  return std::ranges::any_of(primitives, [&](const scene::Primitive& primitive) {
    static const scene::Material plain;  // of primitives without one
    const auto index = static_cast<std::size_t>(primitive.material);
    return scene::casting_faces(node, primitive.material < 0 ? plain : scene.materials[index], choice).has_value();
  });
}

bool is_flat(const Bounds& box) {
  const glm::vec3 size = box.extent();
  return size.y <= flat * std::max(size.x, size.z);
}

float area(const Bounds& box) { return box.extent().x * box.extent().z; }

bool is_floor_of(const Bounds& box, const Bounds& others) {
  const bool beyond = box.min.x <= others.min.x && box.min.z <= others.min.z && box.max.x >= others.max.x &&
                      box.max.z >= others.max.z && area(box) >= wider * area(others);
  return beyond && box.max.y <= others.min.y + low * others.extent().y;
}

}  // namespace

Bounds caster_bounds(const scene::Scene& scene, const scene::Pose& pose, const scene::CasterChoice& choice) {
  const std::vector<Bounds> boxes = scene::node_bounds(scene, pose);
  std::vector<Bounds> casters;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (!boxes[i].empty && casts(scene, scene.nodes[i], choice)) casters.push_back(boxes[i]);
  }
  // The lowest first: a floor is a floor of what is higher.
  std::ranges::sort(casters, {}, [](const Bounds& box) { return box.max.y; });
  Bounds framed;
  for (std::size_t i = casters.size(); i-- > 0;) {
    const bool floor = is_flat(casters[i]) && !framed.empty && is_floor_of(casters[i], framed);
    if (!floor) framed.add(casters[i]);
  }
  return framed.empty ? scene::bounds_of(scene, pose) : framed;
}

}  // namespace penumbra::viewer

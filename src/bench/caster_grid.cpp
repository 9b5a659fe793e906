#include "bench/caster_grid.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <utility>

#include "core/error.h"
#include "scene/pose.h"

namespace penumbra::bench {

namespace {

using scene::Node;
using scene::Primitive;
using scene::Transform;

constexpr int around = 25, across = 20;  // faces of the torus: 2 · 25 · 20 triangles
constexpr float field = 20.0F;           // metres, side of the grid

// A torus about +Y with radius 1 and tube radius 0.4, which touches the plane y = -0.4.
Primitive torus() {
  constexpr float tube = 0.4F;
  Primitive mesh;
  for (int i = 0; i <= around; ++i) {
    for (int j = 0; j <= across; ++j) {
      const float u = glm::two_pi<float>() * static_cast<float>(i) / around;
      const float v = glm::two_pi<float>() * static_cast<float>(j) / across;
      const glm::vec3 out(std::cos(u), 0, std::sin(u));
      const glm::vec3 normal = std::cos(v) * out + glm::vec3(0, std::sin(v), 0);
      mesh.positions.push_back(out + tube * normal);
      mesh.normals.push_back(normal);
    }
  }
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const auto at = [](int a, int b) { return static_cast<std::uint32_t>(a * (across + 1) + b); };
      for (const std::uint32_t corner :
           {at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)})
        mesh.indices.push_back(corner);
    }
  }
  return mesh;
}

Primitive plane() {
  constexpr float half = 0.6F * field;
  return {.indices = {0, 1, 2, 0, 2, 3},
          .positions = {{-half, 0, -half}, {-half, 0, half}, {half, 0, half}, {half, 0, -half}},
          .normals = std::vector<glm::vec3>(4, {0, 1, 0})};
}

// Cells of a square grid about the origin of the x-z plane, row by row, of side 1.
std::vector<glm::vec2> cells(long long count) {
  const auto side = static_cast<long long>(std::ceil(std::sqrt(static_cast<double>(count))));
  const float middle = 0.5F * static_cast<float>(side - 1);
  std::vector<glm::vec2> places;
  for (long long i = 0; i < count; ++i) {
    const long long column = i % side, row = i / side;
    places.emplace_back(static_cast<float>(column) - middle, static_cast<float>(row) - middle);
  }
  return places;
}

long long triangles_of(const scene::Mesh& mesh) {
  long long triangles = 0;
  for (const Primitive& primitive : mesh.primitives) {
    if (primitive.topology == scene::Topology::triangles)
      triangles += static_cast<long long>(primitive.indices.size() / 3);
  }
  return triangles;
}

// Of a node, with all its instances.
long long triangles_of(const scene::Scene& scene, const Node& node) {
  if (node.mesh < 0) return 0;
  return triangles_of(scene.meshes[static_cast<std::size_t>(node.mesh)]) *
         static_cast<long long>(std::max<std::size_t>(node.instances.size(), 1));
}

bool repeats(const Node& node) { return node.mesh >= 0 && node.skin < 0; }

// Copies the node's instances to every offset. Offsets are in world space, instances in the node's space.
void repeat(Node& node, const glm::mat4& world, const std::vector<glm::vec3>& offsets) {
  if (node.instances.empty()) node.instances.emplace_back();
  const std::vector<Transform> own = std::exchange(node.instances, {});
  const glm::mat3 to_node = glm::inverse(glm::mat3(world));
  for (const glm::vec3& offset : offsets) {
    for (Transform instance : own) {
      instance.translation += to_node * offset;
      node.instances.push_back(instance);
    }
  }
}

}  // namespace

long long drawn_triangles(const scene::Scene& scene) {
  const scene::Pose pose = scene::rest_pose(scene);
  long long triangles = 0;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (pose.drawn[i]) triangles += triangles_of(scene, node);
  }
  return triangles;
}

scene::Scene caster_grid(long long triangles) {
  constexpr long long each = 2LL * around * across;
  constexpr float fill = 0.35F;  // torus radius in cells
  const long long count = std::max<long long>((triangles + each / 2) / each, 1);
  const float cell = field / std::ceil(std::sqrt(static_cast<float>(count)));
  Node casters{.name = "casters", .mesh = 0};
  for (const glm::vec2& place : cells(count)) {
    const float radius = fill * cell;
    casters.instances.push_back({.translation = {place.x * cell, radius, place.y * cell}, .scale = glm::vec3(radius)});
  }
  scene::Scene scene{.name = "caster grid"};
  scene.meshes = {{.name = "torus", .primitives = {torus()}}, {.name = "plane", .primitives = {plane()}}};
  scene.nodes = {std::move(casters), {.name = "plane", .mesh = 1}};
  scene.roots = {0, 1};
  return scene;
}

scene::Scene repeated(scene::Scene scene, long long triangles) {
  const scene::Pose pose = scene::rest_pose(scene);
  const scene::Bounds bounds = scene::bounds_of(scene, pose);
  long long single = 0, all = drawn_triangles(scene);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (pose.drawn[i] && !repeats(scene.nodes[i])) single += triangles_of(scene, scene.nodes[i]);
  }
  if (all <= single) fail("nothing in the scene can be repeated");
  const long long count = std::max(1LL, (triangles - single + all - single - 1) / (all - single));
  const float side = std::max({bounds.extent().x, bounds.extent().z, 1e-3F});
  std::vector<glm::vec3> offsets;
  for (const glm::vec2& place : cells(count)) offsets.emplace_back(place.x * side, 0, place.y * side);
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    if (repeats(scene.nodes[i]) && pose.drawn[i]) repeat(scene.nodes[i], pose.world[i], offsets);
  }
  return scene;
}

}  // namespace penumbra::bench

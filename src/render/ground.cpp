#include "render/ground.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <map>

#include "render/setup.h"

namespace penumbra::render {

namespace {

constexpr int inner = 32;  // cells along each side of the scene's footprint
constexpr int rim = 4;     // cells around the footprint and around raised objects, on which their shadows are expected
constexpr int cells = inner + 2 * rim;
constexpr float enough = 0.6f;         // least share of those cells that must have a floor
constexpr float low = 0.1f;            // share of the scene's height that counts as the bottom
constexpr float level = 0.7f;          // least share of a triangle's area that is visible from above
constexpr float radii = 6.0f;          // half the side of the ground, in radii of the scene
constexpr std::size_t copies = 10000;  // most instances that are examined

constexpr std::size_t cell_index(int x, int y) {
  return static_cast<std::size_t>(y) * cells + static_cast<std::size_t>(x);
}

using Cells = std::bitset<static_cast<std::size_t>(cells) * cells>;

// The scene's outline on the ground, as a grid of cells.
class Footprint {
 public:
  explicit Footprint(const scene::Bounds& bounds)
      : origin_(bounds.min.x, bounds.min.z),
        scale_(static_cast<float>(inner) / glm::max(glm::vec2(bounds.extent().x, bounds.extent().z), 1e-9f)) {}

  void cover(Cells& covered_cells, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const {
    const std::array<glm::vec2, 3> corners{cell(a), cell(b), cell(c)};
    const glm::ivec2 first =
        glm::max(glm::ivec2(glm::floor(glm::min(corners[0], glm::min(corners[1], corners[2])))), 0);
    const glm::ivec2 last =
        glm::min(glm::ivec2(glm::floor(glm::max(corners[0], glm::max(corners[1], corners[2])))), cells - 1);
    for (int y = first.y; y <= last.y; ++y) {
      for (int x = first.x; x <= last.x; ++x) {
        if (holds(corners, glm::vec2(x, y) + 0.5f)) covered_cells.set(cell_index(x, y));
      }
    }
  }

 private:
  glm::vec2 cell(const glm::vec3& p) const { return (glm::vec2(p.x, p.z) - origin_) * scale_ + float{rim}; }

  static bool holds(const std::array<glm::vec2, 3>& corners, const glm::vec2& p) {
    int positive = 0, negative = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec2 edge = corners[(i + 1) % 3] - corners[i], to = p - corners[i];
      const float side = edge.x * to.y - edge.y * to.x;
      positive += side > 0 ? 1 : 0;
      negative += side < 0 ? 1 : 0;
    }
    return positive == 0 || negative == 0;
  }

  glm::vec2 origin_, scale_;
};

bool mostly(const Cells& marked, const Cells& of) {
  return static_cast<float>((marked & of).count()) >= enough * static_cast<float>(of.count());
}

// The unmarked cells within `rim` cells of marked ones.
Cells rim_of(const Cells& marked) {
  Cells grown;
  for (int y = 0; y < cells; ++y) {
    for (int x = 0; x < cells; ++x) {
      if (!marked[cell_index(x, y)]) continue;
      for (int v = std::max(y - rim, 0); v <= std::min(y + rim, cells - 1); ++v) {
        for (int u = std::max(x - rim, 0); u <= std::min(x + rim, cells - 1); ++u) {
          grown.set(cell_index(u, v));
        }
      }
    }
  }
  return grown & ~marked;
}

Cells outline() {
  Cells all;
  for (int y = rim; y < cells - rim; ++y) {
    for (int x = rim; x < cells - rim; ++x) all.set(cell_index(x, y));
  }
  return all;
}

// The cells that have low, level triangles, and those that have triangles above `top`.
struct Layers {
  Footprint footprint;
  float top;  // height below which a triangle is low
  Cells floor, above;
  std::map<int, float> areas;  // of level triangles that are low, by their material
};

bool faces_up(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const glm::vec3 area = glm::cross(b - a, c - a);
  return std::abs(area.y) > level * glm::length(area);
}

void add(Layers& layers, const scene::Primitive& primitive, const glm::mat4& world) {
  std::vector<glm::vec3> positions;
  positions.reserve(primitive.positions.size());
  for (const glm::vec3& position : primitive.positions) positions.emplace_back(world * glm::vec4(position, 1.0f));
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const glm::vec3& a = positions[primitive.indices[i]];
    const glm::vec3& b = positions[primitive.indices[i + 1]];
    const glm::vec3& c = positions[primitive.indices[i + 2]];
    if (std::max({a.y, b.y, c.y}) > layers.top) {
      layers.footprint.cover(layers.above, a, b, c);
    } else if (faces_up(a, b, c)) {
      layers.footprint.cover(layers.floor, a, b, c);
      layers.areas[primitive.material] += glm::length(glm::cross(b - a, c - a));
    }
  }
}

}  // namespace

Floor find_floor(const scene::Scene& scene, const scene::Pose& pose, const scene::Bounds& bounds) {
  Layers layers{.footprint = Footprint(bounds),
                .top = bounds.min.y + std::max(low * bounds.extent().y, 1e-3f * bounds.radius())};
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const scene::Node& node = scene.nodes[i];
    if (!pose.drawn[i] || node.mesh < 0 || node.skin >= 0) continue;
    for (const scene::Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      if (primitive.topology != scene::Topology::triangles) continue;
      if (node.instances.empty()) add(layers, primitive, pose.world[i]);
      for (std::size_t copy = 0; copy < std::min(node.instances.size(), copies); ++copy) {
        add(layers, primitive, pose.world[i] * scene::to_matrix(node.instances[copy]));
      }
    }
  }
  Floor floor{.wide = mostly(layers.floor, outline()) && mostly(layers.floor, rim_of(layers.above))};
  const auto largest = std::max_element(layers.areas.begin(), layers.areas.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
  if (largest == layers.areas.end() || largest->first < 0) return floor;
  const scene::Material& material = scene.materials[static_cast<std::size_t>(largest->first)];
  if (material.base_color_texture.texture < 0) floor.albedo = glm::clamp(glm::vec3(material.base_color), 0.0f, 1.0f);
  return floor;
}

void add_ground(scene::Scene& scene, const scene::Bounds& bounds) {
  const float radius = bounds.empty ? 1.0f : std::max(bounds.radius(), 1e-6f);
  const float half = radii * radius;
  const glm::vec3 center = bounds.empty ? glm::vec3(0.0f) : bounds.center();
  const float height = (bounds.empty ? 0.0f : bounds.min.y) - 1e-4f * radius;  // below floors of the scene
  scene::Primitive plane;
  for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1)}) {
    plane.positions.emplace_back(center.x + half * corner.x, height, center.z + half * corner.y);
    plane.normals.emplace_back(0, 1, 0);
  }
  plane.indices = {0, 1, 2, 0, 2, 3};
  plane.material = static_cast<int>(scene.materials.size());
  scene.materials.push_back(
      {.name = "ground", .base_color = glm::vec4(glm::vec3(ground_albedo), 1.0f), .metallic = 0.0f});
  scene::Node node{.name = "ground"};
  node.ground = true;
  node.mesh = static_cast<int>(scene.meshes.size());
  scene.meshes.push_back({.name = "ground", .primitives = {std::move(plane)}});
  scene.roots.push_back(static_cast<int>(scene.nodes.size()));
  scene.nodes.push_back(std::move(node));
}

}  // namespace penumbra::render

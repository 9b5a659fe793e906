#include "scene/sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "core/log.h"
#include "core/names.h"
#include "scene/casting.h"
#include "scene/gpu_scene_materials.h"
#include "scene/one_line.h"

namespace penumbra::scene {
namespace {

constexpr std::size_t most_triangles = 200'000;  // a shell with more is not a simple sky
constexpr std::size_t most_skies = 8;
constexpr int direction_count = 128;  // over the whole sphere, spread evenly
constexpr float lowest = 0.1f;        // sine of the elevation that a dome must reach down to
constexpr double filled = 0.97;       // least share of covered directions; allows for seams and a hole for the sun
constexpr float far_off = 2;          // times the radius of everything else
constexpr std::array<std::string_view, 4> names = {"sky", "backdrop", "panorama", "hdri"};

// A spiral of equal areas from the zenith to the nadir.
std::array<glm::vec3, direction_count> make_directions() {
  std::array<glm::vec3, direction_count> directions{};
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < direction_count; ++i) {
    const double y = 1 - (2 * i + 1.0) / direction_count, radius = std::sqrt(1 - y * y);
    directions[static_cast<std::size_t>(i)] = {radius * std::cos(golden * i), y, radius * std::sin(golden * i)};
  }
  return directions;
}

// What a ray from the centre hits.
struct Seen {
  float nearest = std::numeric_limits<float>::infinity();  // metres
  bool front = false;                                      // it hits a triangle's front, or one that is double-sided
};
using View = std::array<Seen, direction_count>;

struct Hit {
  float distance;
  bool front;
};

// Ray-triangle intersection, both faces (Möller and Trumbore 1997).
std::optional<Hit> hit_of(const glm::vec3& a, const glm::vec3& ab, const glm::vec3& ac, const glm::vec3& direction) {
  const glm::vec3 p = glm::cross(direction, ac);
  const float determinant = glm::dot(ab, p);
  if (determinant == 0) return {};
  const float u = glm::dot(-a, p) / determinant;
  const glm::vec3 q = glm::cross(-a, ab);
  const float v = glm::dot(direction, q) / determinant, distance = glm::dot(ac, q) / determinant;
  constexpr float seam = 1e-4f;  // tolerance, so that adjacent triangles leave no gap
  if (!(u >= -seam && v >= -seam && u + v <= 1 + seam && distance > 0)) return {};
  return Hit{distance, determinant > 0};
}

bool holds(std::string_view text) {
  const std::string lower = lower_case(text);
  return std::ranges::any_of(names, [&](std::string_view name) { return lower.find(name) != std::string::npos; });
}

bool only_shines(const Material& material) {
  const bool dark = std::max({material.base_color.r, material.base_color.g, material.base_color.b}) == 0;
  return material.unlit || (dark && material.emissive != glm::vec3(0));
}

class SkyFinder {
 public:
  SkyFinder(const Scene& scene, const Pose& pose)
      : scene_(scene), pose_(pose), boxes_(node_bounds(scene, pose)), directions_(make_directions()) {}

  std::vector<int> find() {
    std::vector<int> skies;
    for (std::optional<int> sky = outermost(); sky && skies.size() < most_skies; sky = outermost()) {
      skies.push_back(*sky);
      boxes_[static_cast<std::size_t>(*sky)] = {};
    }
    return skies;
  }

 private:
  const Mesh& mesh_of(std::size_t node) const {
    return scene_.meshes[static_cast<std::size_t>(scene_.nodes[node].mesh)];
  }

  // For each node, the box of all other nodes is the union of the boxes before it and behind it in the list.
  std::optional<int> outermost() const {
    const std::size_t count = boxes_.size();
    std::vector<Bounds> behind(count + 1);
    for (std::size_t i = count; i-- > 0;) {
      behind[i] = behind[i + 1];
      behind[i].add(boxes_[i]);
    }
    Bounds before;
    for (std::size_t i = 0; i < count; ++i) {
      Bounds rest = before;
      rest.add(behind[i + 1]);
      if (is_sky(i, rest)) return static_cast<int>(i);
      before.add(boxes_[i]);
    }
    return {};
  }

  bool is_sky(std::size_t node, const Bounds& rest) const {
    const Bounds& box = boxes_[node];
    if (box.empty || rest.empty || !(rest.radius() > 0)) return false;
    const bool around = box.min.x < rest.min.x && box.min.z < rest.min.z && box.max.x > rest.max.x &&
                        box.max.z > rest.max.z && box.max.y > rest.max.y;
    if (!around || !scene_.nodes[node].instances.empty() || scene_.nodes[node].skin >= 0) return false;
    const std::optional<View> view = view_of(node, rest.center());
    return view && fills_the_sky(*view) && (is_named_or_shines(node) || is_far_off(*view, rest.radius()));
  }

  std::optional<View> view_of(std::size_t node, const glm::vec3& middle) const {
    std::size_t triangles = 0;
    for (const Primitive& primitive : mesh_of(node).primitives) triangles += primitive.indices.size() / 3;
    if (triangles > most_triangles) return {};
    View view{};
    for (const Primitive& primitive : mesh_of(node).primitives)
      if (primitive.topology == Topology::triangles) look_at(primitive, pose_.world[node], middle, view);
    return view;
  }

  void look_at(const Primitive& primitive, const glm::mat4& world, const glm::vec3& middle, View& view) const {
    const bool mirrored = glm::determinant(glm::mat3(world)) < 0;
    const bool double_sided =
        primitive.material >= 0 && scene_.materials[static_cast<std::size_t>(primitive.material)].double_sided;
    const auto corner = [&](std::size_t i) {
      return glm::vec3(world * glm::vec4(primitive.positions[primitive.indices[i]], 1)) - middle;
    };
    for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
      const glm::vec3 a = corner(i), ab = corner(i + 1) - a, ac = corner(i + 2) - a;
      for (std::size_t d = 0; d < directions_.size(); ++d) {
        const std::optional<Hit> hit = hit_of(a, ab, ac, directions_[d]);
        if (!hit) continue;
        view[d].nearest = std::min(view[d].nearest, hit->distance);
        view[d].front = view[d].front || double_sided || hit->front != mirrored;
      }
    }
  }

  bool fills_the_sky(const View& view) const {
    int above = 0, filled_above = 0;
    for (std::size_t d = 0; d < directions_.size(); ++d) {
      if (directions_[d].y < lowest) continue;
      ++above;
      filled_above += view[d].front ? 1 : 0;
    }
    return filled_above >= filled * above;
  }

  bool is_named_or_shines(std::size_t node) const {
    const Mesh& mesh = mesh_of(node);
    if (holds(scene_.nodes[node].name) || holds(mesh.name)) return true;
    return std::ranges::all_of(mesh.primitives, [&](const Primitive& primitive) {
      if (primitive.material < 0) return false;
      const Material& material = scene_.materials[static_cast<std::size_t>(primitive.material)];
      return holds(material.name) || only_shines(material);
    });
  }

  static bool is_far_off(const View& view, float radius) {
    return std::ranges::all_of(view, [&](const Seen& seen) { return seen.nearest >= far_off * radius; });
  }

  const Scene& scene_;
  const Pose& pose_;
  std::vector<Bounds> boxes_;  // per node, of its triangles; empty if it has none or was found to be a sky
  std::array<glm::vec3, direction_count> directions_;
};

std::string quoted_or(const std::string& name, const std::string& otherwise) {
  return name.empty() ? otherwise : "'" + name + "'";
}

}  // namespace

std::vector<int> find_skies(const Scene& scene, const Pose& pose) { return SkyFinder(scene, pose).find(); }

void warn_of_skies(const std::filesystem::path& file, const Scene& scene) {
  for (std::size_t number = 0; number < scene.nodes.size(); ++number) {
    const Node& node = scene.nodes[number];
    if (!node.sky) continue;
    for (const Primitive& primitive : scene.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      const Material& material = Materials::of(scene, primitive.material);
      if (!casts_as_parameters_say(node, material)) continue;
      warn("{}: {}", file.string(),
           one_line(fmt::format(
               "node {} (material {}) encloses the scene as a sky does; it casts no shadow unless casters.skies is on",
               quoted_or(node.name, std::to_string(number)), quoted_or(material.name, "without a name"))));
      break;
    }
  }
}

}  // namespace penumbra::scene

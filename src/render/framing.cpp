#include "render/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "render/setup.h"

namespace penumbra::render {

namespace {

constexpr float automatic_fov = glm::radians(40.0f);
constexpr float automatic_azimuth = glm::radians(30.0f);
constexpr float margin = 0.05f;
constexpr float least_seen = 0.1f;
constexpr float flat = 0.1f;           // most height of a flat node, in its widths
constexpr float much_wider = 4.0f;     // least width of a flat node that is not framed, in those of what stands on it
constexpr float just_wider = 1.1f;     // the same where only what casts shadows is asked for
constexpr float least_framed = 1e-3f;  // least size of what is framed without it, in those of the scene
constexpr float shadow_room = 0.5f;    // around what is framed without it, in heights

using Corners = std::array<glm::vec3, 8>;

Corners corners_of(const glm::vec3& low, const glm::vec3& high) {
  Corners corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = {(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z};
  }
  return corners;
}

// The least distance from the box's centre, back along the view axis, at which all corners are within planes through
// the eye at an angle of that tangent to the axis.
float distance_for(const Corners& corners, const glm::vec3& axis, const glm::vec3& back, float tangent) {
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
  for (const glm::vec3& corner : corners) {
    high = std::max(high, glm::dot(corner, axis) + tangent * glm::dot(corner, back));
    low = std::min(low, glm::dot(corner, axis) - tangent * glm::dot(corner, back));
  }
  return (high - low) * 0.5f / tangent;
}

// How far to shift the eye along `axis`, at that distance, so that the box's projection is centred. In perspective this
// is not a simple mean: the sum of the outermost slopes falls monotonically as the eye moves, so bisection finds its
// zero.
float centered(const Corners& corners, const glm::vec3& axis, const glm::vec3& back, float distance) {
  float low = std::numeric_limits<float>::max(), high = std::numeric_limits<float>::lowest();
  for (const glm::vec3& corner : corners) {
    low = std::min(low, glm::dot(corner, axis));
    high = std::max(high, glm::dot(corner, axis));
  }
  for (int i = 0; i < 24; ++i) {
    const float eye = (low + high) * 0.5f;
    float least = std::numeric_limits<float>::max(), most = std::numeric_limits<float>::lowest();
    for (const glm::vec3& corner : corners) {
      const float slope = (glm::dot(corner, axis) - eye) / (distance - glm::dot(corner, back));
      least = std::min(least, slope);
      most = std::max(most, slope);
    }
    (least + most > 0 ? low : high) = eye;
  }
  return (low + high) * 0.5f;
}

// Flat scenes are viewed from a higher elevation.
float elevation_for(const glm::vec3& half) {
  const float flatness = half.y / std::max({half.x, half.y, half.z});
  return glm::radians(glm::mix(36.0f, 16.0f, glm::clamp(flatness * 1.5f, 0.0f, 1.0f)));
}

// The part of the picture that is covered, in NDC: -1 to 1 on both axes.
struct Cover {
  glm::vec2 low{1.0f}, high{-1.0f};

  void add(const glm::vec4& clip) {
    const glm::vec2 at = glm::clamp(glm::vec2(clip.x, clip.y) / clip.w, -1.0f, 1.0f);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
};

// The part of a convex polygon, in clip space, on the inner side of a plane.
std::vector<glm::vec4> clipped(const std::vector<glm::vec4>& polygon, const glm::vec4& plane) {
  std::vector<glm::vec4> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::vec4 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const float from = glm::dot(plane, a), to = glm::dot(plane, b);
    if (from >= 0) kept.push_back(a);
    if ((from < 0) != (to < 0)) kept.push_back(glm::mix(a, b, from / (from - to)));
  }
  return kept;
}

// Adds the visible parts of the box's faces.
void add_faces(Cover& cover, const Corners& corners, const glm::mat4& to_clip) {
  static constexpr std::array<glm::vec4, 6> inner{
      {{1, 0, 0, 1}, {-1, 0, 0, 1}, {0, 1, 0, 1}, {0, -1, 0, 1}, {0, 0, -1, 1}, {0, 0, 1, 0}}};
  static constexpr std::array<std::array<std::size_t, 4>, 6> faces{
      {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
  for (const auto& face : faces) {
    std::vector<glm::vec4> polygon;
    for (const std::size_t corner : face) polygon.push_back(to_clip * glm::vec4(corners[corner], 1));
    for (const glm::vec4& plane : inner) polygon = clipped(polygon, plane);
    for (const glm::vec4& point : polygon) cover.add(point);
  }
}

bool holds(const scene::Bounds& box, const glm::vec3& point) {
  return glm::all(glm::lessThanEqual(box.min, point)) && glm::all(glm::lessThanEqual(point, box.max));
}

// Adds those corners of an orthographic view volume that are inside the box. Needed when the camera is inside the box,
// whose faces may then all be outside the picture.
void add_inside(Cover& cover, const glm::mat4& to_clip, const scene::Bounds& bounds) {
  const glm::mat4 to_world = glm::inverse(to_clip);
  for (const glm::vec3& corner : corners_of({-1, -1, 0}, {1, 1, 1})) {
    if (holds(bounds, glm::vec3(to_world * glm::vec4(corner, 1)))) cover.add(glm::vec4(corner, 1));
  }
}

float width_of(const scene::Bounds& bounds) { return std::max(bounds.extent().x, bounds.extent().z); }

// The bounds of the nodes without floors, which are flat, lie under all nodes that are less wide, and are `wider` times
// as wide as these together. Nothing if none is a floor. What is left is no smaller than `least`.
std::optional<scene::Bounds> without_floors(std::vector<scene::Bounds> nodes, float wider, float least) {
  std::erase_if(nodes, [](const scene::Bounds& node) { return node.empty; });
  std::ranges::sort(nodes, {}, width_of);
  std::vector<scene::Bounds> up_to{{}};  // the bounds of the first nodes
  for (const scene::Bounds& node : nodes) {
    up_to.push_back(up_to.back());
    up_to.back().add(node);
  }
  // Of the widest ones, as many as are flat and lie under all that are less wide.
  const auto lies_under = [](const scene::Bounds& node, const scene::Bounds& others) {
    return node.extent().y <= flat * width_of(node) && node.center().y <= others.center().y;
  };
  std::size_t framed = nodes.size();
  for (std::size_t i = nodes.size(); i-- > 1 && lies_under(nodes[i], up_to[i]);) {
    if (up_to[i].radius() > least && width_of(nodes[i]) >= wider * width_of(up_to[i])) framed = i;
  }
  return framed == nodes.size() ? std::nullopt : std::optional(up_to[framed]);
}

bool casts(const scene::Scene& scene, const scene::Node& node, const scene::CasterChoice& choice) {
  if (node.mesh < 0) return false;
  const auto& primitives = scene.meshes[static_cast<std::size_t>(node.mesh)].primitives;
  return std::ranges::any_of(primitives, [&](const scene::Primitive& primitive) {
    static const scene::Material plain;  // of primitives without one
    const auto index = static_cast<std::size_t>(primitive.material);
    return scene::casting_faces(node, primitive.material < 0 ? plain : scene.materials[index], choice).has_value();
  });
}

}  // namespace

scene::Bounds framed_bounds(std::vector<scene::Bounds> nodes, const scene::Bounds& all) {
  std::optional<scene::Bounds> bounds = without_floors(std::move(nodes), much_wider, least_framed * all.radius());
  if (!bounds) return all;
  const float room = shadow_room * bounds->extent().y;
  bounds->min -= glm::vec3(room, 0, room);
  bounds->max += glm::vec3(room, 0, room);
  return *bounds;
}

scene::Bounds caster_bounds(const scene::Scene& scene, const scene::Pose& pose, const scene::CasterChoice& choice) {
  const std::vector<scene::Bounds> boxes = scene::node_bounds(scene, pose);
  std::vector<scene::Bounds> casters;
  scene::Bounds together;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    if (boxes[i].empty || !casts(scene, scene.nodes[i], choice)) continue;
    casters.push_back(boxes[i]);
    together.add(boxes[i]);
  }
  if (casters.empty()) return scene::bounds_of(scene, pose);
  return without_floors(std::move(casters), just_wider, /* least= */ 0).value_or(together);
}

Camera framing_camera(const scene::Bounds& bounds, float aspect) {
  const float radius = std::max(bounds.radius(), 1e-6f);
  const glm::vec3 half = glm::max(bounds.extent() * 0.5f, glm::vec3(1e-3f * radius));
  const Corners corners = corners_of(-half, half);
  const glm::vec3 back = direction_to(automatic_azimuth, elevation_for(half));
  const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(0, 1, 0), back));
  const glm::vec3 up = glm::cross(back, right);
  const float tangent = (1.0f - 2.0f * margin) * std::tan(automatic_fov * 0.5f);
  const float distance =
      std::max(distance_for(corners, right, back, tangent * aspect), distance_for(corners, up, back, tangent));
  const glm::vec3 eye = bounds.center() + right * centered(corners, right, back, distance) +
                        up * centered(corners, up, back, distance) + back * distance;
  return look_at(eye, eye - back * distance, automatic_fov, near_plane_for(bounds, eye));
}

bool sees(const Camera& camera, float aspect, const scene::Bounds& bounds) {
  if (!camera.orthographic && holds(bounds, position_of(camera))) return true;
  const glm::mat4 to_clip = projection_of(camera, aspect) * camera.view;
  Cover cover;
  add_faces(cover, corners_of(bounds.min, bounds.max), to_clip);
  if (camera.orthographic) add_inside(cover, to_clip, bounds);
  const glm::vec2 size = (cover.high - cover.low) * 0.5f;
  return std::min(size.x, size.y) > 0 && std::max(size.x, size.y) >= least_seen;
}

}  // namespace penumbra::render

#include "lamp_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "shared/cube_faces.h"

namespace penumbra::shadow {

namespace {

constexpr double texels_beyond = 8;                          // that receivers at the edge read besides
constexpr double widest_single_map = glm::pi<double>() / 3;  // half angle
constexpr double most_far_over_near = 2000;  // else 32-bit depths are off by more than 1e-4 of a distance

// The rotation from the lamp's space to a face's.
glm::dmat3 turn_of(int face) {
  glm::dmat3 turn;
  for (int i = 0; i < 3; ++i) {
    glm::vec3 axis(0);
    axis[i] = 1;
    turn[i] = glsl::seen_by_face(axis, face);
  }
  return turn;
}

// A plane through a point of the world, with the side that the normal points to in front.
glm::dvec4 plane(const glm::dvec3& normal, const glm::dvec3& through) { return {normal, -glm::dot(normal, through)}; }

// To a power of 2^(1/4), so that the planes seldom move while casters do.
double step_up(double value) { return std::exp2(std::ceil(4 * std::log2(value)) / 4); }
double step_down(double value) { return std::exp2(std::floor(4 * std::log2(value)) / 4); }

double distance_to(const Box& box, const glm::dvec3& point) {
  return glm::length(glm::max(glm::max(glm::dvec3(box.min) - point, point - glm::dvec3(box.max)), glm::dvec3(0)));
}

double farthest_of(const Box& box, const glm::dvec3& point) {
  return glm::length(glm::max(glm::abs(glm::dvec3(box.min) - point), glm::abs(glm::dvec3(box.max) - point)));
}

}  // namespace

glm::dmat4 LampMaps::world_to_clip(int face) const {
  const glm::dmat3 to_face = turn_of(face) * world_to_lamp;
  glm::dmat4 world_to_face(to_face);
  world_to_face[3] = glm::dvec4(-(to_face * position), 1);
  glm::dmat4 projection(0);
  projection[0][0] = projection[1][1] = 1 / tangent;
  projection[2][2] = far / (far - near);
  projection[3][2] = -near * far / (far - near);
  projection[2][3] = 1;
  return projection * world_to_face;
}

CullVolume LampMaps::cull_volume(int face) const {
  const glm::dmat3 axes = glm::transpose(turn_of(face) * world_to_lamp);  // the face's, in the world
  const auto side = [&](const glm::dvec3& across) {
    return plane(glm::normalize(axes[2] * tangent - across), position);
  };
  return {.planes = {side(axes[0]), side(-axes[0]), side(axes[1]), side(-axes[1]),
                     plane(axes[2], position + axes[2] * near), plane(-axes[2], position + axes[2] * far)}};
}

CullVolume LampMaps::cull_volume_of_all() const {
  if (count == 1) return cull_volume(0);
  CullVolume volume;
  for (glm::length_t i = 0; i < 3; ++i) {
    glm::dvec3 axis(0);
    axis[i] = 1;
    volume.planes[static_cast<size_t>(2 * i)] = plane(axis, position - axis * far);
    volume.planes[static_cast<size_t>(2 * i + 1)] = plane(-axis, position + axis * far);
  }
  return volume;
}

double LampMaps::greatest_stretch() const { return std::sqrt(1 + 2 * tangent * tangent); }

std::string LampMaps::fault() const {
  const bool finite = std::isfinite(glm::dot(position, position)) && std::isfinite(tangent) && std::isfinite(far) &&
                      std::isfinite(radius);
  if (!finite) return "the lamp's maps are not finite";
  if ((count != 1 && count != cube_faces) || size < 1) return "the lamp has no maps";
  if (!(near > 0) || !(far > near) || !(tangent > 0)) return "the lamp's maps have no extent";
  if (near < far / most_far_over_near * (1 - 1e-6))
    return fmt::format("the lamp's maps have a near plane at {:.3g} m, less than 1/{} of the far plane's {:.3g} m",
                       near, most_far_over_near, far);
  return {};
}

bool has_one_map(const glm::dvec3& axis, double cone) { return glm::length(axis) > 0 && cone <= widest_single_map; }

LampMaps fit_lamp(const LampInputs& in) {
  LampMaps maps{
      .position = in.position, .size = in.size, .radius = in.radius, .range = in.range, .drawn_reversed = true};
  const bool spot = glm::length(in.axis) > 0;
  maps.world_to_lamp = spot ? light_axes(-in.axis) : light_axes(glm::dvec3(0, 1, 0));
  if (spot) maps.cone = std::cos(in.cone);
  maps.count = has_one_map(in.axis, in.cone) ? 1 : cube_faces;
  const double reach = farthest_of(in.receivers, in.position) * 1.001;
  const double far = step_up(in.range > 0 ? std::min(in.range, reach) : reach);
  maps.near = std::max({in.nearest, step_down(0.5 * distance_to(in.casters, in.position)), far / most_far_over_near});
  maps.far = std::max(far, 2 * maps.near);
  // A blocker at distance b moves a disc's rim by up to (1 + t²) · radius / b of the tangent t.
  const double rim = maps.count == 1 ? std::tan(in.cone) : 1.0;
  const double nearest = std::max<double>(glsl::clear_distance(static_cast<float>(in.radius)), maps.near);
  maps.tangent = (rim + (1 + rim * rim) * in.radius / nearest) / (1 - std::min(2 * texels_beyond / in.size, 0.5));
  return maps;
}

double least_depth(const LampMaps& maps, const Box& box) {
  // Of all points at a distance, those at a cube's corners are nearest along the face's axis.
  const double distance = distance_to(box, maps.position);
  return std::max(maps.near, distance / (maps.count == 1 ? maps.greatest_stretch() : std::sqrt(3.0)));
}

}  // namespace penumbra::shadow

#include "truth/receiver.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>

#include "truth/posed_triangle.h"

namespace penumbra::truth {

namespace {

struct Ray {
  glm::dvec3 origin{0}, direction{0};
};

// The eye of a picture: a point (perspective), or a direction (orthographic).
class Eye {
 public:
  explicit Eye(const EyeRays& rays) : rays_(rays) {
    // The world line of clip space's z axis passes through the eye (perspective) or is parallel to the rays
    // (orthographic).
    const glm::dvec4 axis = rays.clip_to_world[2];
    perspective_ = axis.w != 0;
    if (perspective_) {
      origin_ = glm::dvec3(axis) / axis.w;
    } else {
      // With x right, y up and z towards the eye the system is right-handed; with z away from the eye its determinant
      // is negative.
      const double towards = glm::determinant(glm::dmat3(rays.clip_to_world)) < 0 ? -1 : 1;
      forward_ = glm::normalize(glm::dvec3(axis)) * -towards;
    }
  }

  Ray ray(int x, int y) const {
    const glm::dvec2 ndc(2 * (x + 0.5) / rays_.width - 1, 2 * (y + 0.5) / rays_.height - 1);
    const glm::dvec4 place = rays_.clip_to_world * glm::dvec4(ndc, 0.5, 1);
    const glm::dvec3 point = glm::dvec3(place) / place.w;
    if (!perspective_) return {point, forward_};
    // The point half way between near and far plane in clip space is in front of the eye, also with an infinite far
    // plane.
    return {origin_, glm::normalize(point - origin_)};
  }

  // In perspective, points behind the eye are not visible.
  bool before(const Ray& ray, const glm::dvec3& point) const {
    return !perspective_ || glm::dot(point - ray.origin, ray.direction) > 0;
  }

 private:
  EyeRays rays_;
  bool perspective_ = false;
  glm::dvec3 origin_{0}, forward_{0};
};

double distance_to(const Ray& ray, const glm::dvec3& point) {
  return glm::length(glm::cross(point - ray.origin, ray.direction));
}

glm::dvec3 nearest_corner(const Ray& ray, const Corners& corners) {
  return *std::ranges::min_element(corners, {}, [&](const glm::dvec3& c) { return distance_to(ray, c); });
}

Receiver receiver_at(const Eye& eye, const Ray& ray, const Corners& corners) {
  Receiver receiver;
  receiver.there = true;
  receiver.normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  const glm::dvec3 to_eye = ray.origin - corners[0];
  const double height = glm::dot(receiver.normal, to_eye);
  const double descent = glm::dot(receiver.normal, ray.direction);
  receiver.position = corners[0] + (to_eye - ray.direction * (height / descent));
  const glm::dvec3& p = receiver.position;
  if (!std::isfinite(p.x + p.y + p.z) || !eye.before(ray, p)) receiver.position = nearest_corner(ray, corners);
  if (descent > 0) receiver.normal = -receiver.normal;
  for (const glm::dvec3& corner : corners)
    receiver.extent = std::max(receiver.extent, glm::length(corner - receiver.position));
  return receiver;
}

Receiver receiver_of(const scene::PosedGeometry& geometry, const Eye& eye, const glm::uvec2& drawn,
                     const glm::ivec2& pixel) {
  if (drawn.x >= geometry.surfaces.size()) return {};
  const auto corners = world_triangle(geometry.surfaces[drawn.x], drawn.y);
  return corners ? receiver_at(eye, eye.ray(pixel.x, pixel.y), *corners) : Receiver{};
}

}  // namespace

std::vector<Receiver> receivers_of(const scene::PosedGeometry& geometry, const EyeRays& rays,
                                   std::span<const glm::uvec2> drawn) {
  assert(drawn.size() == static_cast<std::size_t>(rays.width) * static_cast<std::size_t>(rays.height));
  std::vector<Receiver> receivers;
  receivers.reserve(drawn.size());
  const Eye eye(rays);
  for (int y = 0; y < rays.height; ++y) {
    for (int x = 0; x < rays.width; ++x)
      receivers.push_back(receiver_of(geometry, eye, drawn[receivers.size()], {x, y}));
  }
  return receivers;
}

std::vector<Receiver> receivers_of(const scene::PosedGeometry& geometry, const EyeRays& rays,
                                   std::span<const DrawnPixel> pixels) {
  std::vector<Receiver> receivers;
  receivers.reserve(pixels.size());
  const Eye eye(rays);
  for (const DrawnPixel& shown : pixels) receivers.push_back(receiver_of(geometry, eye, shown.drawn, shown.pixel));
  return receivers;
}

}  // namespace penumbra::truth

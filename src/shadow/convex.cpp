#include "convex.h"

#include <algorithm>
#include <cmath>

namespace penumbra::shadow {

namespace {

// The points of a convex polygon in a plane with that normal, in order around their middle.
void sort_around(Polygon& points, const glm::dvec3& normal) {
  glm::dvec3 middle(0);
  for (const glm::dvec3& point : points) middle += point / static_cast<double>(points.size());
  const glm::dvec3 other = std::abs(normal.x) < std::abs(normal.y) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 x = glm::cross(normal, other);
  const glm::dvec3 y = glm::cross(normal, x);
  const auto angle = [&](const glm::dvec3& point) {
    return std::atan2(glm::dot(point - middle, y) / glm::length(y), glm::dot(point - middle, x) / glm::length(x));
  };
  std::ranges::sort(points, {}, angle);
}

}  // namespace

void clip(Polygon& polygon, const HalfSpace& side, Polygon& spare) {
  spare.clear();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(a, side.normal) - side.limit;
    const double db = glm::dot(b, side.normal) - side.limit;
    if (da <= 0) spare.push_back(a);
    if ((da < 0 && db > 0) || (da > 0 && db < 0)) spare.push_back(glm::mix(a, b, da / (da - db)));
  }
  polygon.swap(spare);
}

void clip(std::vector<Polygon>& faces, const HalfSpace& side) {
  Polygon cut, spare;
  for (Polygon& face : faces) {
    // Where the outline crosses the plane; points on the plane belong to the cut too.
    for (size_t i = 0; i < face.size(); ++i) {
      const glm::dvec3& a = face[i];
      const glm::dvec3& b = face[(i + 1) % face.size()];
      const double da = glm::dot(a, side.normal) - side.limit;
      const double db = glm::dot(b, side.normal) - side.limit;
      if (da == 0) cut.push_back(a);
      if ((da < 0 && db > 0) || (da > 0 && db < 0)) cut.push_back(glm::mix(a, b, da / (da - db)));
    }
    clip(face, side, spare);
  }
  std::erase_if(faces, [](const Polygon& face) { return face.empty(); });
  if (faces.empty() || cut.size() < 3) return;
  sort_around(cut, side.normal);
  faces.push_back(std::move(cut));
}

}  // namespace penumbra::shadow

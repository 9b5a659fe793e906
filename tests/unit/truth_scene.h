#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <glm/glm.hpp>
#include <vector>

#include "truth/tracer.h"

namespace penumbra::test {

constexpr double pi = 3.14159265358979323846;

// A scene of a few surfaces that a test adds.
class TruthScene {
 public:
  scene::Scene scene;

  // Surfaces hold pointers to primitives, so these must not move in memory.
  scene::Primitive& add_primitive() { return primitives_.emplace_back(); }

  scene::PosedSurface& place(const scene::Primitive& primitive, const glm::mat4& world = glm::mat4(1)) {
    geometry_.surfaces.push_back({.primitive = &primitive, .positions = primitive.positions, .world = world});
    return geometry_.surfaces.back();
  }

  scene::PosedSurface& add_triangles(std::vector<glm::vec3> positions) {
    scene::Primitive& primitive = add_primitive();
    for (std::uint32_t i = 0; i < positions.size(); ++i) primitive.indices.push_back(i);
    primitive.positions = std::move(positions);
    return place(primitive);
  }

  // corner, + u, + u + v, + v: indices 0 1 2, 0 2 3.
  scene::PosedSurface& add_quad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
    scene::Primitive& primitive = add_primitive();
    primitive.positions = {corner, corner + u, corner + u + v, corner + v};
    primitive.indices = {0, 1, 2, 0, 2, 3};
    return place(primitive);
  }

  void add_box(const glm::vec3& low, const glm::vec3& high) {
    const glm::vec3 d = high - low;
    const glm::vec3 x(d.x, 0, 0), y(0, d.y, 0), z(0, 0, d.z);
    add_quad(low, x, z);
    add_quad(low, y, x);
    add_quad(low, z, y);
    add_quad(high, -z, -x);
    add_quad(high, -x, -y);
    add_quad(high, -y, -z);
  }

  const scene::PosedGeometry& geometry() const { return geometry_; }
  truth::Tracer tracer(const truth::BuildOptions& options = {}) const {
    return truth::Tracer(scene, geometry_, options);
  }

 private:
  std::deque<scene::Primitive> primitives_;
  scene::PosedGeometry geometry_;
};

// A receiver on a triangle whose furthest corner is `extent` metres away.
inline truth::Receiver receiver_at(const glm::dvec3& position, const glm::dvec3& normal, double extent = 100) {
  return {.position = position, .normal = normal, .there = true, .extent = extent};
}

// On the ground y = 0, from x = low to high.
inline std::vector<truth::Receiver> ground_row(double low, double high, int count, double z = 0) {
  std::vector<truth::Receiver> row;
  for (int i = 0; i < count; ++i) {
    row.push_back(receiver_at({low + (high - low) * (i + 0.5) / count, 0, z}, {0, 1, 0}));
  }
  return row;
}

// Share of a unit disc with x < t.
inline double disc_share(double t) {
  t = std::clamp(t, -1.0, 1.0);
  return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / pi;
}

inline double rmse(const std::vector<float>& values, const std::vector<double>& exact) {
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += (values[i] - exact[i]) * (values[i] - exact[i]);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

inline double largest_error(const std::vector<float>& values, const std::vector<double>& exact) {
  double largest = 0;
  for (std::size_t i = 0; i < values.size(); ++i) largest = std::max(largest, std::abs(values[i] - exact[i]));
  return largest;
}

inline truth::Traced trace_row(const truth::Tracer& tracer, const std::vector<truth::Receiver>& row,
                               const truth::TracedLight& light, const truth::TraceOptions& options = {}) {
  return tracer.trace(row, static_cast<int>(row.size()), light, options);
}

}  // namespace penumbra::test

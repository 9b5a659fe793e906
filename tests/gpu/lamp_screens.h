#pragma once

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "gpu/lamp_scenes.h"

namespace penumbra::test {

// A half-plane across a direction, 1 m from a lamp at the origin, whose edge passes through that direction.
struct Screen {
  glm::vec3 towards, edge;  // unit, perpendicular

  glm::vec3 covered() const { return glm::cross(towards, edge); }

  double place(const glm::dvec3& point, double radius) const {
    const glm::dvec3 through(towards);
    glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(edge), point - through));
    if (glm::dot(normal, glm::dvec3(covered())) > 0) normal = -normal;
    const double sine = glm::dot(normal, -point) / glm::length(point);
    return glm::length(point) * sine / std::sqrt(1 - sine * sine) / radius;
  }
};

// A wall 3 m from a lamp at the origin, as seen from between it and the screen.
inline TriangleScene scene_of(const Screen& screen, int side) {
  TriangleScene scene;
  const glm::vec3 across = screen.covered();
  scene.add_quad(3.0f * screen.towards - 4.0f * (screen.edge + across), 8.0f * screen.edge, 8.0f * across);
  scene.add_quad(screen.towards - 4.0f * screen.edge, 8.0f * screen.edge, 4.0f * across);
  scene.width = scene.height = side;
  scene.view = glm::lookAt(1.2f * screen.towards, 3.0f * screen.towards, screen.edge);
  scene.projection = perspective(0.7f, 1, 0.01f);
  return scene;
}

// Across edges and a corner of the cube, along them and oblique to them.
inline const std::vector<Screen>& screens() {
  static const float s = std::sqrt(0.5f), c = std::sqrt(1 / 3.0f);
  static const std::vector<Screen> all{{{s, 0, s}, {0, 1, 0}},
                                       {{s, 0, s}, {s, 0, -s}},
                                       {{0, s, -s}, {1, 0, 0}},
                                       {{c, c, c}, {s, -s, 0}},
                                       {{-c, c, -c}, glm::normalize(glm::vec3(1, 0.2f, -0.8f))}};
  return all;
}

inline int face_of(const glm::vec3& p) {
  const glm::vec3 a = glm::abs(p);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
  return 2 * axis + (p[axis] < 0 ? 1 : 0);
}

// Steps of a picture's error between neighbours that the same face of the cube sees, and between those of two faces.
struct Steps {
  double within = 0, across = 0, worst_error = 0;
  double mean_across = 0;  // the greatest mean over the pairs of any two faces
  int pairs = 0;           // across
};

// `bright`: of pixels of which the light shows more than a half, or not; absent: of all.
inline Steps steps_of(const Shadowed& shadowed, const Screen& screen, float radius, std::optional<bool> bright = {}) {
  std::vector<double> exact, error;
  for (size_t i = 0; i < shadowed.points.size(); ++i) {
    exact.push_back(exact_disc(screen.place(glm::dvec3(shadowed.points[i]), radius)));
    error.push_back(shadowed.mask[4 * i] - exact.back());
  }
  Steps steps;
  std::map<std::pair<int, int>, std::vector<double>> seams;
  const auto compare = [&](size_t i, size_t k) {
    if (bright && (exact[i] > 0.5) != *bright) return;
    const int of_i = face_of(shadowed.points[i]), of_k = face_of(shadowed.points[k]);
    double& step = of_i == of_k ? steps.within : steps.across;
    step = std::max(step, std::abs(error[i] - error[k]));
    if (of_i < of_k) seams[{of_i, of_k}].push_back(error[k] - error[i]);
    if (of_k < of_i) seams[{of_k, of_i}].push_back(error[i] - error[k]);
    steps.pairs += of_i == of_k ? 0 : 1;
    steps.worst_error = std::max(steps.worst_error, std::abs(error[i]));
  };
  const auto width = static_cast<size_t>(shadowed.width);
  for (size_t i = 0; i + width < error.size(); ++i) {
    if ((i + 1) % width != 0) compare(i, i + 1);
    compare(i, i + width);
  }
  for (const auto& [faces, of_seam] : seams) {
    const double mean = std::accumulate(of_seam.begin(), of_seam.end(), 0.0) / static_cast<double>(of_seam.size());
    if (of_seam.size() >= 10) steps.mean_across = std::max(steps.mean_across, std::abs(mean));
  }
  return steps;
}

}  // namespace penumbra::test

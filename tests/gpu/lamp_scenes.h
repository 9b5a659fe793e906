#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <vector>

#include "gpu/exact_penumbra.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {

inline constexpr float lamp_height = 2.5f;  // metres above the ground

// A half-plane x < edge at a height above the ground, below a lamp over the origin. `z`: of the receivers.
struct Edge {
  float height, radius;  // of the half-plane; of the lamp
  float x = 0, z = 0;

  // Where the lamp's centre casts the shadow of the edge.
  float shadow_x() const { return x * lamp_height / (lamp_height - height); }
  float penumbra_radius() const { return radius * height / (lamp_height - height); }

  // Of the penumbra radius, how far a point of the ground is from the edge of the umbra's middle: where the plane
  // through the point and the edge cuts the disc that faces the point.
  double place(const glm::dvec3& point) const {
    const glm::dvec2 along(x - point.x, height);
    const glm::dvec2 normal = glm::dvec2(along.y, -along.x) / glm::length(along);
    const glm::dvec3 to_lamp = glm::dvec3(0, lamp_height, 0) - point;
    const double sine = -glm::dot(normal, glm::dvec2(to_lamp)) / glm::length(to_lamp);
    return -glm::length(to_lamp) * sine / std::sqrt(1 - sine * sine) / radius;
  }
};

inline TriangleScene scene_of(const Edge& edge, int width) {
  // Off the lamp's axis penumbrae are wider.
  const float reach =
      1.25f * edge.penumbra_radius() * (1 + edge.shadow_x() * edge.shadow_x() / (lamp_height * lamp_height));
  const glm::vec3 middle(edge.shadow_x(), 0, edge.z);
  TriangleScene scene;
  scene.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  scene.add_quad({-4, edge.height, -4}, {0, 0, 8}, {4 + edge.x, 0, 0});
  scene.width = width;
  scene.height = 2;
  scene.view = glm::lookAt(middle + glm::vec3(0, edge.height / 2, 0), middle, glm::vec3(0, 0, -1));
  scene.projection = orthographic(reach, reach * 2 / static_cast<float>(width), 0.01f, edge.height);
  return scene;
}

inline shadow::Lamp point_lamp(float radius) { return {.position = {0, lamp_height, 0}, .radius = radius}; }

inline shadow::Lamp spot(float radius, float cone_degrees) {
  shadow::Lamp lamp = point_lamp(radius);
  lamp.axis = {0, -1, 0};
  lamp.cone = glm::radians(cone_degrees);
  return lamp;
}

// Shadows under one lamp.
class Lamps : public TriangleTest {
 protected:
  Shadowed render(const TriangleScene& scene, const shadow::Lamp& lamp, const ParamSet& params) {
    const std::vector<shadow::Light> lights{{.source = lamp}};
    return renderer_->render(scene, params, [&](shadow::Inputs& inputs) { inputs.lights = lights; });
  }
};

}  // namespace penumbra::test

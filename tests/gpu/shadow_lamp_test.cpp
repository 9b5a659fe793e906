// Shadows of lamps against closed forms, and against themselves where they must not depend on how the maps are made.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/exact_penumbra.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr float lamp_height = 2.5f;  // metres above the ground

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

TriangleScene scene_of(const Edge& edge, int width) {
  // Off the lamp's axis penumbrae are wider.
  const float reach = 1.25f * edge.penumbra_radius() * (1 + edge.shadow_x() * edge.shadow_x() / (lamp_height * lamp_height));
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

shadow::Lamp point_lamp(float radius) { return {.position = {0, lamp_height, 0}, .radius = radius}; }

shadow::Lamp spot(float radius, float cone_degrees) {
  shadow::Lamp lamp = point_lamp(radius);
  lamp.axis = {0, -1, 0};
  lamp.cone = glm::radians(cone_degrees);
  return lamp;
}

class Lamps : public TriangleTest {
 protected:
  Shadowed render(const TriangleScene& scene, const shadow::Lamp& lamp, const ParamSet& params) {
    const std::vector<shadow::Light> lights{{.source = lamp}};
    return renderer_->render(scene, params, [&](shadow::Inputs& inputs) { inputs.lights = lights; });
  }

  // The mean over seeds, so that only the bias is left.
  std::vector<double> mean_visibility(const TriangleScene& scene, const shadow::Lamp& lamp, ParamSet params, int seeds) {
    std::vector<double> mean;
    for (int seed = 0; seed < seeds; ++seed) {
      params.set("sampling.seed", seed);
      const std::vector<float> one = render(scene, lamp, params).visibilities();
      mean.resize(one.size());
      for (size_t i = 0; i < one.size(); ++i) mean[i] += one[i] / seeds;
    }
    return mean;
  }

  // The largest error of a profile.
  double deviation(const Edge& edge, const shadow::Lamp& lamp, const ParamSet& params, int seeds) {
    const TriangleScene scene = scene_of(edge, 64);
    const std::vector<double> mean = mean_visibility(scene, lamp, params, seeds);
    const Shadowed places = render(scene, lamp, params);
    double worst = 0;
    for (size_t i = 0; i < mean.size(); ++i)
      worst = std::max(worst, std::abs(mean[i] - exact_disc(edge.place(glm::dvec3(places.points[i])))));
    return worst;
  }

  // A map of which that many texels cover the penumbra's radius.
  static ParamSet with_texels(ParamSet params, const Edge& edge, double map_tangent, double texels) {
    const double size = 2 * map_tangent * lamp_height * texels / edge.penumbra_radius();
    params.set("lamps.size", static_cast<int>(std::bit_ceil(static_cast<unsigned>(size))));
    return params;
  }
};

const std::vector<Edge>& edges() {
  static const std::vector<Edge> all{{0.5f, 0.05f}, {1, 0.05f}, {1.5f, 0.05f}, {0.5f, 0.1f}, {1, 0.1f},
                                     {1.5f, 0.1f},  {0.5f, 0.2f}, {1, 0.2f},     {1.5f, 0.2f}};
  return all;
}

TEST_F(Lamps, BruteForceMatchesTheExactFunctionUnderASpot) {
  for (const Edge& edge : edges()) {
    ParamSet params = with_texels(renderer_->params(), edge, 0.32, 24);
    params.set("technique", std::string("brute_force"));
    params.set("brute_force.every_texel", true);
    EXPECT_LE(deviation(edge, spot(edge.radius, 10), params, 1), 0.02)
        << "lamp of " << edge.radius << " m, caster at " << edge.height << " m";
  }
}

TEST_F(Lamps, PcssAndSlicesMatchTheExactFunctionUnderASpot) {
  for (const Edge& edge : edges()) {
    ParamSet params = with_texels(renderer_->params(), edge, 0.32, 24);
    params.set("pcss.blocker_taps", 64);
    params.set("pcss.filter_taps", 64);
    EXPECT_LE(deviation(edge, spot(edge.radius, 10), params, 32), 0.03)
        << "pcss, lamp of " << edge.radius << " m, caster at " << edge.height << " m";
    params.set("technique", std::string("slices"));
    params.set("slices.azimuths", 32);
    params.set("slices.samples", 32);
    EXPECT_LE(deviation(edge, spot(edge.radius, 10), params, 8), 0.02)
        << "slices, lamp of " << edge.radius << " m, caster at " << edge.height << " m";
  }
}

// A disc that faces the receiver looks longer to the map than it is: in the direction in which the receiver lies from
// the axis, and not across it.
TEST_F(Lamps, PenumbraeAwayFromTheAxisMatchTheExactFunction) {
  for (const Edge& edge : {Edge{1, 0.2f, 0.9f, 0}, Edge{1, 0.2f, 0, 1.8f}, Edge{1, 0.2f, 0.7f, 1.2f}, Edge{1, 0.2f, 1.4f, 0.8f}}) {
    ParamSet params = renderer_->params();
    params.set("lamps.size", 1024);
    params.set("technique", std::string("brute_force"));
    params.set("brute_force.every_texel", true);
    EXPECT_LE(deviation(edge, point_lamp(edge.radius), params, 1), 0.02) << "edge at " << edge.x << ", z " << edge.z;
    params.set("technique", std::string("slices"));
    params.set("slices.azimuths", 32);
    params.set("slices.samples", 32);
    EXPECT_LE(deviation(edge, point_lamp(edge.radius), params, 8), 0.02) << "edge at " << edge.x << ", z " << edge.z;
  }
}

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

int face_of(const glm::vec3& p) {
  const glm::vec3 a = glm::abs(p);
  const int axis = a.x >= a.y && a.x >= a.z ? 0 : (a.y >= a.z ? 1 : 2);
  return 2 * axis + (p[axis] < 0 ? 1 : 0);
}

TEST_F(Lamps, NoSeamShowsWhereCubeFacesMeet) {
  const float s = std::sqrt(0.5f), c = std::sqrt(1 / 3.0f);
  const std::vector<Screen> screens{{{0, 0, 1}, {0, 1, 0}},{{0.5f, 0, 0.8660254f}, {0, 1, 0}},{{-0.5f, 0, 0.8660254f}, {0, 1, 0}},{{0.5f, 0, 0.8660254f}, {0.8660254f, 0, -0.5f}},{{s, 0, s}, {0, 1, 0}},
                                    {{s, 0, s}, {s, 0, -s}},
                                    {{0, s, -s}, {1, 0, 0}},
                                    {{c, c, c}, {s, -s, 0}},
                                    {{-c, c, -c}, glm::normalize(glm::vec3(-1, 0.2f, 1.2f))}};
  const float radius = 0.1f;
  for (const Screen& screen : screens) {
    TriangleScene scene;
    scene.add_quad(3.0f * screen.towards - 4.0f * (screen.edge + screen.covered()), 8.0f * screen.edge, 8.0f * screen.covered());
    scene.add_quad(screen.towards - 4.0f * screen.edge, 8.0f * screen.edge, 4.0f * screen.covered());
    scene.width = scene.height = 96;
    scene.view = glm::lookAt(1.2f * screen.towards, 3.0f * screen.towards, screen.edge);
    scene.projection = perspective(0.7f, 1, 0.01f);
    ParamSet params = renderer_->params();
    params.set("technique", std::string("slices"));
    params.set("slices.azimuths", 32);
    params.set("slices.samples", 32);
    if (getenv("TECH")) params.set("technique", std::string(getenv("TECH")));
    if (getenv("SIZE")) params.set("lamps.size", atoi(getenv("SIZE")));
    const Shadowed shadowed = render(scene, {.radius = radius}, params);
    std::vector<double> error;
    for (size_t i = 0; i < shadowed.points.size(); ++i)
      error.push_back(shadowed.visibilities()[i] - exact_disc(screen.place(glm::dvec3(shadowed.points[i]), radius)));
    double across = 0, within = 0, worst = 0;
    int pairs = 0;
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x + 1 < scene.width; ++x) {
        const auto i = static_cast<size_t>(y * scene.width + x);
        const bool same = face_of(shadowed.points[i]) == face_of(shadowed.points[i + 1]);
        double& step = same ? within : across;
        step = std::max(step, std::abs(error[i + 1] - error[i]));
        pairs += same ? 0 : 1;
        worst = std::max(worst, std::abs(error[i]));
      }
    }
    if (getenv("DUMP")) {
      for (int y = 0; y < scene.height; y += 4) {
        for (int x = 0; x < scene.width; x += 3) {
          const auto i = static_cast<size_t>(y * scene.width + x);
          printf("%3d/%-3d ", (int)(100*shadowed.visibilities()[i]), (int)(100*(shadowed.visibilities()[i]-error[i])));if(getenv("RAD"))printf("r%.3f d%.2f l%.1f ",shadowed.mask[4*i+1],shadowed.mask[4*i+2],shadowed.mask[4*i+3]);
        }
        printf("\n");
      }
    }
    printf("across %.4f (%d) within %.4f worst %.4f\n", across, pairs, within, worst);
    EXPECT_GT(pairs, 40);
  }
}

}  // namespace
}  // namespace penumbra::test

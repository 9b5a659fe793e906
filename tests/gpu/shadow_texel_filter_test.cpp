// Penumbrae that are few texels of the map wide, in `slices`, against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/exact_penumbra.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr float sun = 2;  // degrees
constexpr float height = 5;
const float radius = height * std::tan(glm::radians(sun) / 2);

// A half-plane above the ground whose edge passes through the origin, turned from the map's axes. The camera sees as
// much ground as makes the penumbra's radius so many texels of a map of 256².
class TurnedEdge {
 public:
  TurnedEdge(float texels, float degrees) : along_(sin_cos(degrees)) {
    const float reach = 120 * radius / texels;
    near_edge_ = static_cast<double>(radius) * std::max(6.0 / static_cast<double>(texels), 1.2);
    add_half_plane({0, height, 0}, 1);
    scene_.add_quad({-reach, 0, -reach}, {0, 0, 2 * reach}, {2 * reach, 0, 0});
    scene_.receivers = shadow::Box{{-reach, 0, -reach}, {reach, 0, reach}};
    scene_.width = scene_.height = 720;
    scene_.view = glm::lookAt(glm::vec3(0, height / 8, 0), glm::vec3(0), glm::vec3(0, 0, -1));
    scene_.projection = orthographic(reach, reach, 0.01f * height, height);
  }

  // A half-plane that ends at that point and extends to one side of the edge or, with -1, to the other.
  void add_half_plane(const glm::vec3& end, float side) {
    constexpr float far = 400;
    const glm::vec3 along(along_.x, 0, along_.y), across = side * glm::vec3(along_.y, 0, -along_.x);
    scene_.add_quad(end - far * along, 2 * far * along, far * across);
  }

  const TriangleScene& scene() const { return scene_; }

  // Whether a point is among those of which the tests ask: the penumbra and a few texels about it.
  bool is_near(const glm::vec3& point) const { return std::abs(distance(point)) < near_edge_; }

  // Distance of a point from the edge, positive where the half-plane is not above it.
  double distance(const glm::vec3& point) const {
    return -static_cast<double>(point.x * along_.y - point.z * along_.x);
  }

  // The point at that distance, at a height.
  glm::vec3 beside(float distance, float above) const { return {-distance * along_.y, above, distance * along_.x}; }

 private:
  static glm::vec2 sin_cos(float degrees) { return {std::sin(glm::radians(degrees)), std::cos(glm::radians(degrees))}; }

  glm::vec2 along_;
  double near_edge_ = 0;
  TriangleScene scene_;
};

class TexelFilter : public TriangleTest {
 protected:
  ParamSet parameters(int filter_radius) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string("slices"));
    params.set("slices.filter_radius", filter_radius);
    params.set("sun.angle", sun);
    params.set("cascades.count", 1);
    params.set("cascades.size", 256);
    return params;
  }

  // How many texels the penumbra's radius really has.
  float texels() const { return radius / renderer_->mask().lights[0].projection.cascades().texel(0).x; }
};

template <class Exact>
double rmse(const Shadowed& shadowed, const TurnedEdge& edge, Exact exact) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < shadowed.height; ++y) {
    for (int x = 0; x < shadowed.width; ++x) {
      const glm::vec3& point = shadowed.point(x, y);
      if (!edge.is_near(point)) continue;
      const double error = shadowed.visibility(x, y) - exact(edge.distance(point) / static_cast<double>(radius));
      sum += error * error;
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

// Between one texel and the next, an edge that is turned from the map's axes makes a staircase. Smoothed, it is nearer
// to the edge, and no noise is added to it.
TEST_F(TexelFilter, IsNearerToATurnedEdgeThanSlices) {
  struct Bound {
    float texels;
    double ratio;  // of the errors
  };
  for (const Bound& bound : {Bound{0.1f, 0.95}, {0.5f, 0.91}, {1, 0.87}, {2, 0.85}, {5, 0.55}}) {
    for (const float degrees : {10.0f, 27.0f}) {
      const TurnedEdge edge(bound.texels, degrees);
      const double of_slices = rmse(renderer_->render(edge.scene(), parameters(0)), edge, exact_disc);
      const double filtered = rmse(renderer_->render(edge.scene(), parameters(8)), edge, exact_disc);
      std::printf("radius of %.2f texels, edge turned by %.0f degrees: RMSE %.4f, slices %.4f\n",
                  static_cast<double>(texels()), static_cast<double>(degrees), filtered, of_slices);
      EXPECT_LE(filtered, bound.ratio * of_slices);
    }
  }
}

TEST_F(TexelFilter, HasNoNoise) {
  for (const float radius_in_texels : {1.0f, 2.0f, 5.0f}) {
    const TurnedEdge edge(radius_in_texels, 20);
    for (const int filter_radius : {0, 8}) {
      ParamSet params = parameters(filter_radius);
      const Shadowed first = renderer_->render(edge.scene(), params);
      params.set("sampling.seed", 1);
      const Shadowed second = renderer_->render(edge.scene(), params);
      if (filter_radius == 0) {
        EXPECT_NE(first.mask, second.mask) << "slices depend on the seed";
      } else {
        EXPECT_EQ(first.mask, second.mask);
      }
    }
  }
}

TEST_F(TexelFilter, MatchesTheExactFunctionForBothShapesOfTheSun) {
  for (const std::string shape : {"disc", "square"}) {
    const TurnedEdge edge(5, shape == "disc" ? 20.0f : 0.0f);
    ParamSet params = parameters(8);
    params.set("sun.shape", shape);
    const Shadowed shadowed = renderer_->render(edge.scene(), params);
    EXPECT_LE(rmse(shadowed, edge, shape == "disc" ? exact_disc : exact_square), 0.02) << shape;
  }
}

// A second half-plane below the first, a quarter as high, that reaches farther: what both of them hide overlaps.
// Filters add it up twice, slices do not.
TEST_F(TexelFilter, LeavesBlockersAtTwoHeightsToSlices) {
  constexpr float low = height / 4, farther = 0.3f;  // of the higher one's radius
  TurnedEdge edge(5, 0);
  edge.add_half_plane(edge.beside(farther * radius, low), 1);
  const auto exact = [&](double t) { return exact_disc(std::min(t, 4 * (t - static_cast<double>(farther)))); };
  ParamSet params = parameters(8);
  params.set("slices.azimuths", 64);
  params.set("slices.samples", 32);
  const double of_both = rmse(renderer_->render(edge.scene(), params), edge, exact);
  params.set("slices.filter_radius", 0);
  const double of_slices = rmse(renderer_->render(edge.scene(), params), edge, exact);
  params.set("technique", std::string("brute_force"));
  const double of_one_height = rmse(renderer_->render(edge.scene(), params), edge, exact);
  std::printf("two heights: RMSE %.4f, slices alone %.4f, brute_force %.4f\n", of_both, of_slices, of_one_height);
  EXPECT_LE(of_both, 1.1 * of_slices);
  EXPECT_LE(of_both, 0.7 * of_one_height);
}

}  // namespace
}  // namespace penumbra::test

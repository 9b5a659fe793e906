// Screen-space soft shadows against closed forms: the kernel has the penumbra's size on the receiver's plane, and stops
// where the picture shows another surface.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/exact_penumbra.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr float angle = 2;  // of the sun, degrees
const double slope = std::tan(glm::radians(static_cast<double>(angle)) / 2);

// A half-plane x < 0 above a ground that reaches `reach` metres to each side, in a square picture.
struct Edge {
  float height = 5;
  float reach = 1;
  float depth = 1;  // of the ground: how far it reaches along z
  int side = 96;
  glm::vec3 to_light{0, 1, 0};
  float middle = 0;  // x on the ground where the edge's shadow is

  TriangleScene scene() const {
    TriangleScene scene;
    scene.add_quad({middle - reach, 0, -depth}, {0, 0, 2 * depth}, {2 * reach, 0, 0});
    scene.add_quad({-60, height, -60}, {0, 0, 120}, {60, 0, 0});
    scene.receivers = shadow::Box{{middle - reach, 0, -depth}, {middle + reach, 0, depth}};
    scene.width = scene.height = side;
    scene.to_light = to_light;
    look_down(scene);
    return scene;
  }
  // From below the half-plane.
  void look_down(TriangleScene& scene) const {
    scene.view = glm::lookAt(glm::vec3(middle, 0.5f, 0), glm::vec3(middle, 0, 0), glm::vec3(0, 0, -1));
    scene.projection = orthographic(0.98f * reach, 0.98f * reach, 0.01f, 1);
  }
};

// One that shows so much of the ground that all that the kernels of a penumbra read is in the picture.
Edge framed(float height) {
  const auto reach = static_cast<float>(2.5 * slope * static_cast<double>(height));
  return {.height = height, .reach = reach, .depth = reach};
}

class ScreenSpace : public TriangleTest {
 protected:
  void SetUp() override {
    TriangleTest::SetUp();
    params_ = std::make_unique<ParamSet>(renderer_->params());
    params_->set("technique", std::string("ssss"));
    params_->set("sun.angle", angle);
    params_->set("cascades.count", 1);
    params_->set("ssss.search_taps", 64);
    params_->set("ssss.taps", 64);
  }

  // The mean of pictures with different sample points.
  Shadowed mean(const TriangleScene& scene) {
    constexpr int seeds = 16;
    Shadowed sum = renderer_->render(scene, *params_);
    for (int seed = 1; seed < seeds; ++seed) {
      params_->set("sampling.seed", seed);
      const Shadowed one = renderer_->render(scene, *params_);
      for (size_t i = 0; i < sum.mask.size(); ++i) sum.mask[i] += one.mask[i];
    }
    params_->reset("sampling.seed");
    for (float& value : sum.mask) value /= seeds;
    return sum;
  }

  std::unique_ptr<ParamSet> params_;
};

// The largest error where `exact` is known: it is a function of the point on the surface, negative where it is not.
template <class Exact>
double worst_error(const Shadowed& shadowed, Exact exact) {
  double worst = 0;
  int known = 0;
  for (int y = 0; y < shadowed.height; ++y) {
    for (int x = 0; x < shadowed.width; ++x) {
      if (shadowed.sky(x, y)) continue;
      const double value = exact(glm::dvec3(shadowed.point(x, y)));
      if (value < 0) continue;
      ++known;
      const double error = std::abs(static_cast<double>(shadowed.visibility(x, y)) - value);
      if (!(error <= worst)) worst = error;  // also if it is not a number
    }
  }
  EXPECT_GT(known, 50);
  return worst;
}

TEST_F(ScreenSpace, PenumbraOfAStraightEdgeIsTheExactFunction) {
  for (const std::string shape : {"disc", "square"}) {
    for (const float height : {1.0f, 5.0f, 20.0f}) {
      params_->set("sun.shape", shape);
      const Shadowed shadowed = mean(framed(height).scene());
      const double radius = slope * static_cast<double>(height);
      const double worst = worst_error(shadowed, [&](const glm::dvec3& point) {
        if (std::abs(point.z) > 1.3 * radius || std::abs(point.x) > 1.3 * radius) return -1.0;
        return shape == "disc" ? exact_disc(point.x / radius) : exact_square(point.x / radius);
      });
      EXPECT_LE(worst, 0.03) << shape << ", half-plane at " << height << " m";
    }
  }
}

// Across its diagonals a square sun is wider: where little is hidden, that is one of its corners.
TEST_F(ScreenSpace, PenumbraOfASquareSunReachesToItsCorners) {
  params_->set("sun.shape", std::string("square"));
  const Edge edge = framed(5);
  const double radius = slope * 5, half_root = std::sqrt(0.5);
  TriangleScene scene;
  scene.add_quad({-edge.reach, 0, -edge.reach}, {0, 0, 2 * edge.reach}, {2 * edge.reach, 0, 0});
  scene.add_quad({-60, 5, 60}, {120, 0, -120}, {-60, 0, -60});
  scene.receivers = shadow::Box{{-edge.reach, 0, -edge.reach}, {edge.reach, 0, edge.reach}};
  scene.width = scene.height = edge.side;
  edge.look_down(scene);
  int corner = 0;
  const double worst = worst_error(mean(scene), [&](const glm::dvec3& point) {
    if (std::max(std::abs(point.x), std::abs(point.z)) > 1.05 * radius) return -1.0;
    const double t = half_root * (point.x + point.z) / radius;  // from the edge
    const double left = std::max(2 * half_root - std::abs(t), 0.0);
    corner += t > 1.05 && left > 0 ? 1 : 0;
    return t > 0 ? 1 - 0.25 * left * left : 0.25 * left * left;
  });
  EXPECT_GT(corner, 30);
  EXPECT_LE(worst, 0.03);
}

TEST_F(ScreenSpace, WhatIsOutsideOfThePenumbraIsExactlyLitOrDark) {
  const Edge edge = framed(5);
  const Shadowed shadowed = renderer_->render(edge.scene(), *params_);
  const double radius = slope * 5;
  EXPECT_EQ(worst_error(shadowed,
                        [&](const glm::dvec3& point) {
                          if (std::abs(point.x) < 1.15 * radius) return -1.0;
                          return point.x > 0 ? 1.0 : 0.0;
                        }),
            0);
}

TEST_F(ScreenSpace, WidthGrowsWithTheCastersHeight) {
  const double width_over_radius = 1.374;  // from 10 to 90 % of the disc's function
  Edge edge = framed(10);
  edge.side = 192;
  for (const float height : {2.5f, 5.0f, 10.0f}) {
    edge.height = height;
    const Shadowed shadowed = mean(edge.scene());
    std::vector<double> profile;
    for (int x = 0; x < edge.side; ++x) {
      double sum = 0;
      for (int y = 80; y < 112; ++y) sum += static_cast<double>(shadowed.visibility(x, y));
      profile.push_back(sum / 32);
    }
    const double step = 2 * 0.98 * static_cast<double>(edge.reach) / edge.side;
    const double exact = width_over_radius * slope * static_cast<double>(height);
    EXPECT_NEAR(width_10_90(profile, step) / exact, 1, 0.05) << "half-plane at " << height << " m";
  }
}

// The camera looks across the edge at a low angle, so that the disc on the ground is a narrow ellipse in the picture.
TEST_F(ScreenSpace, KernelIsForeshortenedAsThePlaneIs) {
  for (const float elevation : {90.0f, 45.0f}) {
    Edge edge = framed(5);
    edge.to_light = sun_direction(60, elevation);
    edge.middle = -5 * edge.to_light.x / edge.to_light.y;
    edge.reach *= 2;
    edge.depth *= 2;
    edge.side = 256;
    TriangleScene scene = edge.scene();
    const glm::vec3 target(edge.middle, 0, 0);
    const glm::vec3 eye = target + glm::vec3(1.5f, 0.6f, 0.7f);
    scene.view = glm::lookAt(eye, target, glm::vec3(0, 1, 0));
    scene.projection = perspective(2 * std::atan(edge.reach / glm::distance(eye, target)), 1, 0.1f);
    const double radius = slope * 5 / static_cast<double>(edge.to_light.y * edge.to_light.y);
    const double worst = worst_error(mean(scene), [&](const glm::dvec3& point) {
      if (std::abs(point.z) > 0.5 * radius || std::abs(point.x - target.x) > 1.2 * radius) return -1.0;
      return exact_oblique(edge.to_light, point.x, 5, slope);
    });
    EXPECT_LE(worst, 0.05) << "sun at " << elevation << " degrees";
  }
}

// A platform above one half of the ground. The sun is oblique, so that the half-plane's shadow ends elsewhere on the
// platform than beside it on the ground: what the ground shows must not get into the platform's penumbra, whose
// function is the same up to the platform's rim.
TEST_F(ScreenSpace, NothingBleedsOverAStepInDepth) {
  const double cotangent = 1;
  const Edge edge{.height = 10, .reach = 3, .depth = 3, .side = 192, .to_light = {1, 1, 0}, .middle = -8};
  TriangleScene scene = edge.scene();
  scene.to_light = glm::normalize(edge.to_light);
  const float top = 3;
  scene.add_quad({-12, top, -3}, {0, 0, 3}, {10, 0, 0});
  scene.receivers->max.y = top;
  scene.view = glm::lookAt(glm::vec3(-7, 5, 0), glm::vec3(-7, 0, 0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(1.2f, 1.2f, 0.1f, 6);
  const double below = 10 - static_cast<double>(top);
  const double edge_at = -below * cotangent;
  int rim = 0;
  const double worst = worst_error(mean(scene), [&](const glm::dvec3& point) {
    if (point.y < 1 || point.z < -0.5 || std::abs(point.x - edge_at) > 0.5) return -1.0;
    rim += point.z > -0.03 ? 1 : 0;
    return exact_oblique(glm::dvec3(scene.to_light), point.x, below, slope);
  });
  EXPECT_GT(rim, 100) << "the rim is not in the picture";
  EXPECT_LE(worst, 0.08);
}

// The top of a thin column, completely lit by the sun's centre, shows nothing of the shadow's edge. The ground around
// it does.
TEST_F(ScreenSpace, SmallSurfacesGetTheirPenumbraFromWhatIsBehindThem) {
  const Edge edge = framed(5);
  const float top = 0.3f;
  TriangleScene scene = edge.scene();
  scene.add_box({0.005f, 0, -0.02f}, {0.045f, top, 0.02f});
  scene.receivers->max.y = top;
  const double radius = slope * static_cast<double>(edge.height - top);
  const double worst = worst_error(mean(scene), [&](const glm::dvec3& point) {
    return point.y < 0.5 * static_cast<double>(top) ? -1.0 : exact_disc(point.x / radius);
  });
  EXPECT_LE(worst, 0.06);
}

// The sky is infinitely far away.
TEST_F(ScreenSpace, SkyIsLitAndDoesNotBrightenItsNeighbours) {
  Edge edge = framed(5);
  const double radius = slope * 5;
  edge.depth = static_cast<float>(0.5 * radius);
  TriangleScene scene = edge.scene();
  scene.projection = perspective(2 * std::atan(edge.reach / 0.5f), 1, 0.01f);
  const Shadowed shadowed = mean(scene);
  int sky = 0;
  for (int y = 0; y < edge.side; ++y) {
    for (int x = 0; x < edge.side; ++x) {
      if (!shadowed.sky(x, y)) continue;
      ++sky;
      ASSERT_EQ(shadowed.visibility(x, y), 1);
    }
  }
  EXPECT_GT(sky, 1000);
  const double worst = worst_error(shadowed, [&](const glm::dvec3& point) {
    return std::abs(point.x) > 1.3 * radius ? -1.0 : exact_disc(point.x / radius);
  });
  EXPECT_LE(worst, 0.08);
}

TEST_F(ScreenSpace, MostPixelsBoundTheKernel) {
  params_->set("ssss.most_pixels", 4.0f);
  const Edge edge = framed(20);
  const double pixel = 2 * 0.98 * static_cast<double>(edge.reach) / edge.side;
  const Shadowed shadowed = renderer_->render(edge.scene(), *params_);
  EXPECT_EQ(worst_error(shadowed,
                        [&](const glm::dvec3& point) {
                          if (std::abs(point.x) < 5.5 * pixel) return -1.0;
                          return point.x > 0 ? 1.0 : 0.0;
                        }),
            0);
}

}  // namespace
}  // namespace penumbra::test

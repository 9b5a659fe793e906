// The second layer of the shadow map: casters below others keep their shadows.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr double pi = 3.14159265358979323846;

// A half-plane x < 0 at 4 m, and one x < -0.05 m at 1 m, which the first hides from the sun at the zenith.
constexpr float high = 4, low = 1, low_edge = -0.05f;
constexpr float angle = 8;

TriangleScene two_half_planes() {
  TriangleScene scene;
  scene.add_quad({-1, 0, -1}, {0, 0, 2}, {2, 0, 0});
  scene.add_quad({-12, low, -12}, {0, 0, 24}, {12 + low_edge, 0, 0});
  scene.add_quad({-12, high, -12}, {0, 0, 24}, {12, 0, 0});
  scene.receivers = shadow::Box{{-1, 0, -1}, {1, 0, 1}};
  scene.width = 128;
  scene.height = 4;
  scene.view = glm::lookAt(glm::vec3(0, 0.5f, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(0.5f, 0.5f / 32, 0.01f, 1);
  return scene;
}

// The share of a disc that is not hidden by half-planes with parallel edges: of those above a receiver at x, that whose
// edge crosses the disc farthest hides the most, and the others nothing that it does not hide.
double exact(double x, bool both) {
  const double radius = std::tan(glm::radians(static_cast<double>(angle)) / 2);
  double t = x / (radius * static_cast<double>(high));
  if (both) t = std::min(t, (x - static_cast<double>(low_edge)) / (radius * static_cast<double>(low)));
  t = std::clamp(t, -1.0, 1.0);
  return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / pi;
}

// The largest error over the picture, of the mean of some seeds.
double worst_error(TriangleRenderer& renderer, int layers, bool both) {
  const TriangleScene scene = two_half_planes();
  ParamSet params = renderer.params();
  params.set("technique", std::string("slices"));
  params.set("sun.angle", angle);
  params.set("maps.layers", layers);
  params.set("cascades.size", 1024);
  for (const char* name : {"slices.azimuths", "slices.samples"}) params.set(name, 32);
  constexpr int seeds = 16;
  std::vector<double> sums;
  Shadowed last;
  for (int seed = 0; seed < seeds; ++seed) {
    params.set("sampling.seed", seed);
    last = renderer.render(scene, params, [](shadow::Inputs& inputs) { inputs.view.cut = true; });
    const std::vector<float> visibility = last.visibilities();
    sums.resize(visibility.size());
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += static_cast<double>(visibility[i]) / seeds;
  }
  double worst = 0;
  for (int y = 0; y < last.height; ++y) {
    for (int x = 0; x < last.width; ++x) {
      const auto place = static_cast<double>(last.point(x, y).x);
      worst = std::max(worst, std::abs(sums[static_cast<std::size_t>(y * last.width + x)] - exact(place, both)));
    }
  }
  return worst;
}

class ShadowLayers : public TriangleTest {};

TEST_F(ShadowLayers, ACasterBelowAnotherKeepsItsShadow) {
  EXPECT_LT(worst_error(*renderer_, 2, /*both=*/true), 0.02);
  EXPECT_GT(worst_error(*renderer_, 1, /*both=*/true), 0.2) << "one layer does not show the lower half-plane";
  EXPECT_LT(worst_error(*renderer_, 1, /*both=*/false), 0.02);
}

TEST_F(ShadowLayers, WhatIsNearerToTheFirstSurfaceThanTheGapIsLeftOut) {
  const auto with_gap = [&](float gap) {
    ParamSet params = renderer_->params();
    params.set("technique", std::string("slices"));
    params.set("sun.angle", angle);
    params.set("maps.layers", 2);
    params.set("maps.gap", gap);
    return renderer_->render(two_half_planes(), params, [](shadow::Inputs& inputs) { inputs.view.cut = true; }).mask;
  };
  const std::vector<float> none = with_gap(0);
  EXPECT_EQ(with_gap(high - low - 0.1f), none);
  EXPECT_NE(with_gap(high - low + 0.1f), none);
}

// Which layers the second pass draws when a part of the scene moves.
TEST_F(ShadowLayers, OnlyLayersThatHoldWhatMovedAreDrawnAgain) {
  TriangleScene scene = box_on_ground(32);
  scene.casters = scene.receivers = shadow::Box{{-5, 0, -5}, {5, 3, 5}};
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  params.set("cascades.size", 64);
  params.set("maps.layers", 2);
  const auto frame = [&](const TriangleRenderer::Adjust& adjust = {}) {
    std::vector<int> drawn;
    renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
      inputs.draw = [&drawn, draw = inputs.draw](const shadow::CasterPass& casters, gl::Pass& pass) {
        if (casters.kind == shadow::CasterKind::second_depth) drawn.push_back(casters.layer);
        draw(casters, pass);
      };
      if (adjust) adjust(inputs);
    });
    return drawn;
  };
  const std::vector<int> all{0, 1, 2, 3};
  EXPECT_EQ(frame(), all);
  EXPECT_EQ(frame(), std::vector<int>());
  // Far from the finest cascade's column.
  const auto corner = [](shadow::Inputs& inputs) { inputs.moved = shadow::Box{{-5, 0, -5}, {-4.9f, 0.1f, -4.9f}}; };
  const std::vector<int> reached = frame(corner);
  ASSERT_FALSE(reached.empty());
  EXPECT_LT(reached.size(), all.size());
  params.set("maps.gap", 0.1f);
  EXPECT_EQ(frame(corner), all) << "another gap";
  params.set("maps.layers", 1);
  EXPECT_EQ(frame(corner), std::vector<int>());
  params.set("maps.layers", 2);
  EXPECT_EQ(frame(), all) << "the frame before had none";
  params.set("technique", std::string("pcss"));
  EXPECT_EQ(frame(corner), std::vector<int>()) << "does not read it";
}

TEST_F(ShadowLayers, FinishedMapsWithoutCastersCannotHaveOne) {
  const TriangleScene scene = box_on_ground(32);
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  renderer_->render(scene, params);
  const shadow::LightFrame made = renderer_->mask().lights[0];
  params.set("maps.layers", 2);
  try {
    renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
      static std::vector<shadow::Light> lights;
      lights.assign(inputs.lights.begin(), inputs.lights.end());
      const int size = made.projection.size();
      lights[0].maps = shadow::FinishedMaps{{made.depth, size, size}, made.projection};
      inputs.lights = lights;
      inputs.draw = nullptr;
    });
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "recipe 'second_layer' draws casters, and there is no caster callback");
  }
}

}  // namespace
}  // namespace penumbra::test

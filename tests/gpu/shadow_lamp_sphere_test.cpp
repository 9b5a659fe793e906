// A sphere of receivers about a lamp shows no step where the faces of the lamp's cube meet.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <string>
#include <vector>

#include "gpu/lamp_screens.h"

namespace penumbra::test {
namespace {

class LampSphere : public Lamps {};

// The inside of a sphere of 3 m about the lamp: receivers in all directions, of which each sees the lamp in the same
// way. It casts no shadows: only the screen does.
TriangleScene sphere_behind(const Screen& screen, int side) {
  TriangleScene scene = scene_of(screen, side);
  scene.triangles.clear();
  constexpr int columns = 192, rows = 96;
  const auto place = [](int column, int row) {
    const float azimuth = glm::two_pi<float>() * static_cast<float>(column) / columns;
    const float polar = glm::pi<float>() * static_cast<float>(row) / rows;
    return 3.0f * glm::vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth));
  };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const glm::vec3 a = place(column, row), b = place(column + 1, row), c = place(column + 1, row + 1),
                      d = place(column, row + 1);
      if (row > 0) scene.triangles.push_back({a, b, c});
      if (row + 1 < rows) scene.triangles.push_back({a, c, d});
    }
  }
  return scene;
}

// What a technique shows of such a sphere: the mean over a parameter's values. Only the screen casts shadows.
Shadowed mean_sphere(TriangleRenderer& renderer, const Screen& screen, float radius, ParamSet params,
                     const char* varied, const std::vector<int>& values) {
  constexpr int side = 96;
  TriangleScene casters = scene_of(screen, side);
  casters.triangles.erase(casters.triangles.begin(), casters.triangles.begin() + 2);  // the wall
  const Geometry drawn(casters);
  const shadow::Light light{.source = shadow::Lamp{.radius = radius}};
  const TriangleScene scene = sphere_behind(screen, side);
  Shadowed mean;
  for (const int value : values) {
    params.set(varied, value);
    const Shadowed one = renderer.render(scene, params, [&](shadow::Inputs& inputs) {
      inputs.lights = {&light, 1};
      inputs.draw = drawn.casters();
    });
    if (mean.mask.empty()) {
      mean = one;
      mean.mask.assign(one.mask.size(), 0.0f);
    }
    for (size_t i = 0; i < one.mask.size(); ++i) mean.mask[i] += one.mask[i] / static_cast<float>(values.size());
  }
  return mean;
}

// The mean over maps of several sizes, so that it does not matter where the texels lie at the screen's edge.
TEST_F(LampSphere, NoStepShowsOnASphereOfReceivers) {
  constexpr float radius = 0.05f;
  ParamSet params = renderer_->params();
  params.set("technique", std::string("brute_force"));
  params.set("brute_force.every_texel", true);
  int pairs = 0;
  for (const Screen& screen : screens()) {
    const Shadowed shadowed = mean_sphere(*renderer_, screen, radius, params, "lamps.size", {680, 780, 900, 1010});
    const Steps steps = steps_of(shadowed, screen, radius);
    EXPECT_LE(steps.across, 1.0 / 255) << "screen towards " << screen.towards.x << " " << screen.towards.y << " "
                                       << screen.towards.z;
    pairs += steps.pairs;
  }
  EXPECT_GT(pairs, 500);
}

// Where noise hides single steps, the mean of all along a seam shows what the faces differ by: in the darker and in the
// brighter half of the penumbra, since a penumbra of another width differs by opposite steps there.
TEST_F(LampSphere, NoStepOfTheMeanShowsOnASphereOfReceivers) {
  constexpr float radius = 0.05f;
  ParamSet params = renderer_->params();
  params.set("lamps.size", 1024);
  params.set("slices.azimuths", 32);
  params.set("slices.samples", 32);
  params.set("pcss.blocker_taps", 64);
  params.set("pcss.filter_taps", 64);
  for (const char* technique : {"slices", "pcss"}) {
    params.set("technique", std::string(technique));
    for (const Screen& screen : screens()) {
      const Shadowed shadowed =
          mean_sphere(*renderer_, screen, radius, params, "sampling.seed", {0, 1, 2, 3, 4, 5, 6, 7});
      for (const bool bright : {false, true}) {
        const Steps steps = steps_of(shadowed, screen, radius, bright);
        EXPECT_LE(steps.mean_across, 1.0 / 255) << technique << ", screen towards " << screen.towards.x << " "
                                                << screen.towards.y << " " << screen.towards.z;
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::test

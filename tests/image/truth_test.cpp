// The ray-traced truth in a renderer's frame: against closed forms, against another renderer's picture, and against the
// shadow map, which sees the same casters.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/glm.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/picture.h"
#include "image/scene_run.h"
#include "render/setup.h"

namespace penumbra::test {
namespace {

using TruthImage = GpuTest;

// Visibility under a half-plane whose edge is at t = 0, in penumbra radii; scenes/README.md has the formulas.
double exact_disc(double t) {
  t = std::clamp(t, -1.0, 1.0);
  return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / std::numbers::pi;
}
double exact_square(double t) { return 0.5 + 0.5 * std::clamp(t, -1.0, 1.0); }

// World x under each pixel's centre of an orthographic camera that looks down, rows from the top.
std::vector<double> ground_x(const render::Camera& camera, int width, int height) {
  const glm::dmat4 to_world = glm::inverse(glm::dmat4(camera.view));
  std::vector<double> xs;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double half = camera.half_height;
      const glm::dvec4 eye((2 * (x + 0.5) / width - 1) * half * width / height, (1 - 2 * (y + 0.5) / height) * half, 0,
                           1);
      xs.push_back((to_world * eye).x);
    }
  }
  return xs;
}

TEST_F(TruthImage, IsTheExactPenumbraOfAnEdge) {
  constexpr int width = 96, height = 54;
  for (const std::string shape : {"disc", "square"}) {
    SCOPED_TRACE(shape);
    SceneRun run("knife_edge", width, height, "top");
    run.params().set("sun.angle", 8.0f);
    run.params().set("sun.shape", shape);
    run.draw_truth(4096);
    const std::vector<float>& traced = run.traced().traced.visibility;
    const std::vector<double> xs = ground_x(run.camera(), width, height);
    const double radius = 5 * std::tan(glm::radians(4.0));
    double squares = 0;
    double worst = 0;
    int penumbra = 0;
    for (std::size_t i = 0; i < xs.size(); ++i) {
      const std::size_t from_bottom = (height - 1 - i / width) * width + i % width;
      const double exact = shape == "disc" ? exact_disc(xs[i] / radius) : exact_square(xs[i] / radius);
      const double error = std::abs(traced[from_bottom] - exact);
      squares += error * error;
      worst = std::max(worst, error);
      penumbra += exact > 0.02 && exact < 0.98 ? 1 : 0;
    }
    EXPECT_GT(penumbra, width * height / 4);
    EXPECT_LT(std::sqrt(squares / static_cast<double>(xs.size())), 0.001);
    EXPECT_LT(worst, 0.005);
  }
}

// Share of receivers at which the shadow map and the ray to the sun's centre disagree.
double disagreement(SceneRun& run) {
  run.choose("hard");
  const Visibility hard = run.draw(/*cut=*/true);
  run.draw_truth(8);
  const std::vector<float>& rays = run.traced().traced.hard;
  const std::vector<float> normals = run.read_reference_aov("geometric_normal");
  const glm::vec3 to_light = run.sun().to_light;
  const auto width = static_cast<std::size_t>(run.width());
  const std::size_t height = hard.size() / width;
  int receivers = 0;
  int different = 0;
  for (std::size_t i = 0; i < hard.size(); ++i) {
    const glm::vec3 normal(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
    if (hard[i] < 0 || !(glm::dot(normal, to_light) > 0.05f)) continue;
    ++receivers;
    different += std::abs(hard[i] - rays[(height - 1 - i / width) * width + i % width]) > 0.5f ? 1 : 0;
  }
  EXPECT_GT(receivers, static_cast<int>(hard.size() / 20));
  return static_cast<double>(different) / receivers;
}

TEST_F(TruthImage, SeesTheCastersThatTheShadowMapSees) {
  for (const char* scene : {"courtyard", "knife_edge", "posts", "steps", "thesis", "moving", "fence", "foliage"}) {
    SceneRun run(scene, 320, 180);
    EXPECT_LT(disagreement(run), 0.02) << scene;
  }
}

TEST_F(TruthImage, SeesSkinnedAndMorphingCastersWhereTheyAreDrawn) {
  SceneRun run("moving", 320, 180);
  for (const double time : {0.4, 1.1, 2.3}) {
    run.time() = time;
    EXPECT_LT(disagreement(run), 0.01) << time << " s";
  }
}

TEST_F(TruthImage, IsTheSameWhereverTheTechniqueIsAsked) {
  SceneRun run("fence", 96, 54);
  const Visibility mask = run.draw_truth(64);
  const std::vector<float>& traced = run.traced().traced.visibility;
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const float expected = traced[(53 - i / 96) * 96 + i % 96];
    EXPECT_NEAR(mask[i] < 0 ? 1.0f : mask[i], expected, 0.0005);
  }
}

// scripts/cycles_reference.py made the picture and says how. Both renderers see the same surface where their depths
// agree; leaves less than that apart are told from each other by no depth, so a share of the pixels may differ.
TEST_F(TruthImage, AgreesWithCyclesWithinItsNoise) {
  const char* path = PENUMBRA_ROOT "/tests/image/cycles_foliage.exr";
  const image::Picture cycles = image::read_picture(path, "shadow");
  const std::vector<float>& expected = cycles.pixels;
  const std::vector<float> depth = image::read_picture(path, "depth").pixels;
  SceneRun run("foliage", cycles.width, cycles.height);
  run.camera() = render::look_at({1.6f, 1.4f, 1.8f}, {1, 0.55f, -1.2f}, glm::radians(50.0f), 0.01f);
  run.sun().to_light = render::direction_to(glm::radians(-40.0f), glm::radians(40.0f));
  run.params().set("sun.angle", 2.0f);
  const Visibility truth = run.draw_truth(512);
  const std::vector<float>& standard_error = run.traced().traced.standard_error;
  const std::vector<float> seen = run.read_reference_aov("depth");
  constexpr double cycles_noise = 0.00111;  // rms, in the file's metadata
  std::vector<double> errors;               // in standard errors of the difference
  double bias = 0;
  const auto width = static_cast<std::size_t>(cycles.width);
  const std::size_t height = truth.size() / width;
  for (const std::size_t i : penumbra_of(expected)) {
    if (truth[i] < 0 || std::abs(seen[i] - depth[i]) > 0.01f) continue;
    const double own = standard_error[(height - 1 - i / width) * width + i % width];
    errors.push_back(std::abs(truth[i] - expected[i]) / std::hypot(own, cycles_noise));
    bias += truth[i] - expected[i];
  }
  ASSERT_GT(errors.size(), truth.size() / 6);
  std::ranges::sort(errors);
  const auto at = [&](double share) {
    return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size()))];
  };
  // Of a normal distribution 68 % are within 1, and 95 % within 2.
  EXPECT_LT(at(0.68), 1.2);
  EXPECT_LT(at(0.95), 2.5);
  EXPECT_LT(std::abs(bias) / static_cast<double>(errors.size()), 0.0005);
}

}  // namespace
}  // namespace penumbra::test

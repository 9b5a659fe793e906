// Hard and soft shadows against ray-traced truth where surfaces touch: faces in one place, faces that meet at shallow
// angles, smooth folds under grazing light.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"

namespace penumbra::test {
namespace {

using ContactImage = GpuTest;

constexpr int width = 480, height = 270;

// Pixels that are wrong by more than a quarter where the truth is the same all about them: not at the edge of a shadow,
// whose place the map's texels decide.
struct Wrong {
  int dark = 0, lit = 0;
};

bool is_even(const Visibility& truth, int x, int y) {
  constexpr int around = 2;  // pixels
  float least = 1;
  float most = 0;
  for (int v = std::max(y - around, 0); v <= std::min(y + around, height - 1); ++v) {
    for (int u = std::max(x - around, 0); u <= std::min(x + around, width - 1); ++u) {
      const float here = std::abs(truth[static_cast<std::size_t>(v * width + u)]);  // the sky, -1, is lit
      least = std::min(least, here);
      most = std::max(most, here);
    }
  }
  return most - least < 0.1f;
}

Wrong compare(const Visibility& picture, const Visibility& truth) {
  Wrong wrong;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y * width + x);
      if (truth[i] < 0 || std::abs(picture[i] - truth[i]) <= 0.25f || !is_even(truth, x, y)) continue;
      (picture[i] < truth[i] ? wrong.dark : wrong.lit) += 1;
    }
  }
  return wrong;
}

struct Bounds {
  int dark, lit;      // pixels
  double hard, soft;  // RMSE over the picture; of hard shadows against the sun's centre
};

double rmse_of(const Visibility& picture, const Visibility& truth) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] >= 0) all.push_back(i);
  }
  return rmse(picture, truth, all);
}

void expect_truth(const std::string& scene, const Bounds& bounds) {
  SceneRun run(scene, width, height);
  for (const std::string technique : {"hard", "pcss", "brute_force"}) {
    SCOPED_TRACE(testing::Message() << scene << ", " << technique);
    run.choose(technique);
    if (technique == "hard") run.params().set("sun.angle", 0.0f);
    const Visibility truth = run.draw_truth(technique == "hard" ? 8 : 32);
    const Visibility picture = run.draw(/*cut=*/true);
    const Wrong wrong = compare(picture, truth);
    EXPECT_LE(wrong.dark, bounds.dark) << "dark pixels in the light";
    EXPECT_LE(wrong.lit, bounds.lit) << "lit pixels in the shadow";
    EXPECT_LE(rmse_of(picture, truth), technique == "hard" ? bounds.hard : bounds.soft);
  }
}

TEST_F(ContactImage, WhatLiesOnAWallKeepsItInTheDark) { expect_truth("coincident", {2, 5, 0.05, 0.05}); }

TEST_F(ContactImage, FacesThatMeetAtShallowAnglesShowNoDotsAlongTheirSeams) {
  expect_truth("tent", {2, 2, 0.02, 0.01});
}

TEST_F(ContactImage, SmoothFoldsUnderGrazingLightShowNoSpecks) { expect_truth("curtain", {8, 15, 0.06, 0.055}); }

}  // namespace
}  // namespace penumbra::test

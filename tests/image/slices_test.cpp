// What slices promise beyond PCSS: blockers at different heights add up as in the ray-traced truth.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"

namespace penumbra::test {
namespace {

class Slices : public GpuTest {};

struct Figures {
  double penumbra = 0;  // PSNR, dB
  double bias = 0;      // mean error over all receivers
};

Figures figures_of(SceneRun& run, const Visibility& truth, const char* technique) {
  const float angle = run.params().get_float("sun.angle");
  run.choose(technique);
  run.params().set("sun.angle", angle);
  const Visibility picture = run.draw(/*cut=*/true);
  const std::vector<std::uint8_t> shown = run.receivers();
  double error = 0, receivers = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (shown[i] == 0) continue;
    error += static_cast<double>(picture[i] - truth[i]);
    ++receivers;
  }
  std::vector<std::size_t> penumbra;
  for (const std::size_t i : penumbra_of(truth)) {
    if (shown[i] != 0) penumbra.push_back(i);
  }
  return {decibels(rmse(picture, truth, penumbra)), error / receivers};
}

// `gain`: dB in the penumbra over pcss with 16/16 taps, and `bias`: greatest, both with 8 slices of 8 samples.
struct Case {
  const char* scene;
  float angle;
  double gain, bias;
};

TEST_F(Slices, AreNearerToTheTruthThanPcssWithoutBias) {
  for (const auto& [scene, angle, gain, bias] :
       {Case{"thesis", 2, 3, 0.01}, {"foliage", 8, 2.5, 0.002}, {"courtyard", 8, 3, 0.002}, {"fence", 8, 4, 0.002}}) {
    SceneRun run(scene, 320, 180);
    run.params().set("sun.angle", angle);
    const Visibility truth = run.draw_truth(256);
    const Figures pcss = figures_of(run, truth, "pcss"), slices = figures_of(run, truth, "slices");
    std::printf("%s, %g degrees: pcss %.1f dB, bias %.4f; slices %.1f dB, bias %.4f\n", scene,
                static_cast<double>(angle), pcss.penumbra, pcss.bias, slices.penumbra, slices.bias);
    EXPECT_GE(slices.penumbra, pcss.penumbra + gain) << scene;
    EXPECT_LE(std::abs(slices.bias), bias) << scene;
  }
}

}  // namespace
}  // namespace penumbra::test

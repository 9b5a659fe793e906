// What slices promise beyond PCSS: blockers at different heights add up as in the ray-traced truth.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"

namespace penumbra::test {
namespace {

class Slices : public GpuTest {};

struct Figures {
  double all = 0, penumbra = 0;  // PSNR, dB
  double bias = 0;               // mean error over all receivers
};

Figures figures_of(SceneRun& run, const Visibility& truth, const char* technique, int layers = 1,
                   const char* fit = "stable") {
  const float angle = run.params().get_float("sun.angle");
  run.choose(technique);
  run.params().set("sun.angle", angle);
  run.params().set("maps.layers", layers);
  run.params().set("cascades.fit", std::string(fit));
  const Visibility picture = run.draw(/*cut=*/true);
  const std::vector<std::uint8_t> shown = run.receivers();
  double error = 0;
  std::vector<std::size_t> receivers;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (shown[i] == 0) continue;
    error += static_cast<double>(picture[i] - truth[i]);
    receivers.push_back(i);
  }
  std::vector<std::size_t> penumbra;
  for (const std::size_t i : penumbra_of(truth)) {
    if (shown[i] != 0) penumbra.push_back(i);
  }
  return {decibels(rmse(picture, truth, receivers)), decibels(rmse(picture, truth, penumbra)),
          error / static_cast<double>(receivers.size())};
}

// What 8 slices of 8 samples reach at least.
struct Case {
  const char* scene;
  float angle;  // of the sun, degrees
  double gain;  // dB in the penumbra over pcss with 16/16 taps
  double bias;  // the greatest that is allowed, whatever its sign
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

// Maps fitted to the view are turned against the fence, so that large texels of the pyramid hold far and high parts of
// it. If a slice's samples were spread as far, they would miss the boards beside the receiver.
TEST_F(Slices, AreNoWorseInMapsThatAreTurned) {
  SceneRun run("fence", 320, 180);
  run.params().set("sun.angle", 8.0f);
  const Visibility truth = run.draw_truth(256);
  const Figures stable = figures_of(run, truth, "slices"), visible = figures_of(run, truth, "slices", 1, "visible");
  std::printf("fence, 8 degrees: stable %.1f dB, visible %.1f dB\n", stable.all, visible.all);
  EXPECT_GE(visible.all, stable.all - 0.5);
  EXPECT_GE(visible.all, 27);
}

// The first layer of the map hides the objects below the high caster. The undersides of closed objects, were they in
// the second layer, would hide them too.
TEST_F(Slices, SeeWhatIsBelowACasterInTheSecondLayer) {
  SceneRun run("thesis", 320, 180);
  run.params().set("sun.angle", 2.0f);
  const Visibility truth = run.draw_truth(256);
  const Figures one = figures_of(run, truth, "slices"), two = figures_of(run, truth, "slices", 2);
  std::printf("thesis, 2 degrees: one layer %.1f dB, bias %.4f; two layers %.1f dB, bias %.4f\n", one.all, one.bias,
              two.all, two.bias);
  EXPECT_GE(two.all, one.all + 2);
  EXPECT_LE(std::abs(two.bias), 0.002);
}

// The objects' shadows are narrow and the high caster's penumbra is wide: the kernel that removes noise from the second
// must not blur the first.
TEST_F(Slices, DenoisedKeepNarrowPenumbraeWithinAWideOne) {
  SceneRun run("thesis", 640, 360);
  run.params().set("sun.angle", 2.0f);
  const Visibility truth = run.draw_truth(256);
  const Figures one = figures_of(run, truth, "slices_denoised", 1, "visible"),
                two = figures_of(run, truth, "slices_denoised", 2, "visible");
  std::printf("thesis, 2 degrees, denoised: one layer %.1f / %.1f dB; two layers %.1f / %.1f dB, bias %.4f\n", one.all,
              one.penumbra, two.all, two.penumbra, two.bias);
  EXPECT_GE(two.all, one.all + 6);
  EXPECT_GE(two.penumbra, one.penumbra - 1);
  EXPECT_LE(std::abs(two.bias), 0.002);
}

// Where nothing lies below another caster, pixels are sampled as with one layer.
TEST_F(Slices, LoseNothingByASecondLayerWhereCastersDoNotOverlap) {
  SceneRun run("steps", 320, 180);
  for (const float angle : {0.53f, 2.0f}) {
    run.params().set("sun.angle", angle);
    const Visibility truth = run.draw_truth(256);
    const Figures one = figures_of(run, truth, "slices_denoised"), two = figures_of(run, truth, "slices_denoised", 2);
    std::printf("steps, %g degrees, denoised: one layer %.2f / %.2f dB; two layers %.2f / %.2f dB\n",
                static_cast<double>(angle), one.all, one.penumbra, two.all, two.penumbra);
    EXPECT_NEAR(two.all, one.all, 0.1);
    EXPECT_NEAR(two.penumbra, one.penumbra, 0.1);
  }
}

// A software rasteriser ends loops after a limit. At a seam the most slices and samples run twice in a pixel.
TEST_F(Slices, OfTheMostSamplesAreComplete) {
  SceneRun run("posts", 48, 32);
  const auto draw = [&](double share) {
    run.choose("slices");
    run.params().set("sun.angle", 4.0f);
    run.params().set("cascades.blend", 0.5f);
    for (const char* name : {"slices.azimuths", "slices.samples"})
      run.params().set(name, static_cast<int>(share * run.params().row(name).max));
    return run.draw(/*cut=*/true);
  };
  const Visibility half = draw(0.5), all = draw(1);
  const Visibility truth = run.draw_truth(256);
  const std::vector<std::size_t> penumbra = penumbra_of(truth);
  ASSERT_GT(penumbra.size(), 50u);
  EXPECT_LT(rmse(all, half, penumbra), 0.02);
}

// Beyond the edge of the only map there are no casters: one that reaches the edge must not go on there.
TEST_F(Slices, SeeNothingBesideTheMap) {
  SceneRun run("posts", 160, 90);
  const auto draw = [&](const char* technique) {
    run.choose(technique);
    run.params().set("sun.angle", 20.0f);
    for (const char* setting : {"cascades.count=1", "cascades.distance=3", "cascades.size=256"})
      run.params().assign(setting);
    for (const char* name : {"slices.azimuths", "slices.samples"}) run.params().set(name, 32);
    return run.draw(/*cut=*/true);
  };
  const Visibility slices = draw("slices"), reference = draw("brute_force");
  double darkest = 0;
  for (std::size_t i = 0; i < slices.size(); ++i)
    darkest = std::min(darkest, static_cast<double>(slices[i]) - static_cast<double>(reference[i]));
  EXPECT_GT(darkest, -0.06);
}

}  // namespace
}  // namespace penumbra::test

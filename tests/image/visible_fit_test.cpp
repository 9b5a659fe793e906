// Maps that are fitted to what the view shows, or to where penumbrae may be in it (cascades.fit): narrow penumbrae come
// nearer to the ray-traced truth.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"

namespace penumbra::test {
namespace {

class VisibleFit : public GpuTest {};

// PSNR over all receivers, dB.
double figure_of(SceneRun& run, const Visibility& truth, const char* fit) {
  run.params().set("cascades.fit", std::string(fit));
  const Visibility picture = run.draw(/*cut=*/true);
  const std::vector<std::uint8_t> shown = run.receivers();
  std::vector<std::size_t> receivers;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (shown[i] != 0) receivers.push_back(i);
  }
  return decibels(rmse(picture, truth, receivers));
}

TEST_F(VisibleFit, ComesNearerToTheTruth) {
  // `gain`: least, dB. In `courtyard`, blended glass lies in front of what the depth texture shows.
  struct Case {
    const char* scene;
    double gain;
  };
  for (const auto& [scene, gain] : {Case{"posts", 5}, {"foliage", 1}, {"courtyard", 1}}) {
    SceneRun run(scene, 320, 180);
    run.choose("pcss");
    run.params().set("cascades.size", 1024);
    const Visibility truth = run.draw_truth(64);
    const double stable = figure_of(run, truth, "stable"), visible = figure_of(run, truth, "visible");
    std::printf("%s: stable %.1f dB, visible %.1f dB\n", scene, stable, visible);
    EXPECT_GE(visible, stable + gain) << scene;
  }
}

// Where little of the picture is penumbra, maps of the same size show that in more detail.
TEST_F(VisibleFit, ComesNearerStillWhereOnlyPenumbraeAreFitted) {
  struct Case {
    const char* scene;
    double gain;  // least, dB
  };
  for (const auto& [scene, gain] : {Case{"steps", 1}, {"foliage", 0.5}}) {
    SceneRun run(scene, 320, 180);
    run.choose("pcss");
    run.params().set("cascades.size", 1024);
    const Visibility truth = run.draw_truth(64);
    const double visible = figure_of(run, truth, "visible"), penumbrae = figure_of(run, truth, "penumbrae");
    std::printf("%s: visible %.1f dB, penumbrae %.1f dB\n", scene, visible, penumbrae);
    EXPECT_GE(penumbrae, visible + gain) << scene;
  }
}

}  // namespace
}  // namespace penumbra::test

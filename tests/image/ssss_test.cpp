// What screen-space soft shadows promise on whole scenes: nearer to the ray-traced truth than the hard shadow that they
// blur, with both drivers, and no value that is none.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"

namespace penumbra::test {
namespace {

class ScreenSpaceScenes : public GpuTest {};

Visibility draw(SceneRun& run, const char* technique, float angle, const std::string& driver = "fragment") {
  run.choose(technique);
  run.params().set("sun.angle", angle);
  run.params().set("driver", driver);
  return run.draw(/*cut=*/true);
}

struct Case {
  const char* scene;
  float angle;
  double gain;  // dB in the penumbra over `hard`
};

TEST_F(ScreenSpaceScenes, AreNearerToTheTruthThanTheHardShadow) {
  for (const auto& [scene, angle, gain] :
       {Case{"courtyard", 2, 6}, {"posts", 2, 6}, {"foliage", 2, 6}, {"knife_edge", 2, 17}, {"courtyard", 0.53f, 3}}) {
    SceneRun run(scene, 320, 180);
    run.params().set("sun.angle", angle);
    const Visibility truth = run.draw_truth(256);
    const Visibility hard = draw(run, "hard", angle);
    const Visibility soft = draw(run, "ssss", angle);
    const std::vector<std::uint8_t> shown = run.receivers();
    std::vector<std::size_t> penumbra;
    for (const std::size_t i : penumbra_of(truth)) {
      if (shown[i] != 0) penumbra.push_back(i);
    }
    const double before = decibels(rmse(hard, truth, penumbra));
    const double after = decibels(rmse(soft, truth, penumbra));
    std::printf("%s, %g degrees: hard %.1f dB, ssss %.1f dB\n", scene, static_cast<double>(angle), before, after);
    EXPECT_GE(after, before + gain) << scene;
  }
}

TEST_F(ScreenSpaceScenes, DriversAgreeAndVisibilityIsAShare) {
  for (const char* scene : {"courtyard", "fence", "thesis"}) {
    SceneRun run(scene, 320, 180);
    const Visibility fragment = draw(run, "ssss", 4);
    std::size_t outside = 0;
    for (const float value : fragment) outside += value == -1 || (value >= 0 && value <= 1) ? 0 : 1;
    EXPECT_EQ(outside, 0U) << scene;
    const Visibility compute = draw(run, "ssss", 4, "compute");
    std::size_t apart = 0;
    for (std::size_t i = 0; i < fragment.size(); ++i) apart += fragment[i] != compute[i] ? 1 : 0;
    EXPECT_LE(apart, fragment.size() / 1000) << scene;
  }
}

}  // namespace
}  // namespace penumbra::test

// What backprojection promises beyond PCSS: nearer to the ray-traced truth with as many reads.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"

namespace penumbra::test {
namespace {

class Backprojection : public GpuTest {};

// PSNR in the penumbra, dB.
double penumbra_of_technique(SceneRun& run, const Visibility& truth, const char* technique) {
  const float angle = run.params().get_float("sun.angle");
  run.choose(technique);
  run.params().set("sun.angle", angle);
  run.params().set("pcss.blocker_taps", 41);
  run.params().set("pcss.filter_taps", 40);
  const Visibility picture = run.draw(/*cut=*/true);
  const std::vector<std::uint8_t> shown = run.receivers();
  std::vector<std::size_t> penumbra;
  for (const std::size_t i : penumbra_of(truth)) {
    if (shown[i] != 0) penumbra.push_back(i);
  }
  return decibels(rmse(picture, truth, penumbra));
}

struct Case {
  const char* scene;
  float angle;
  double gain;  // dB over pcss with 81 gathers
};

TEST_F(Backprojection, IsNearerToTheTruthThanPcssWithAsManyReads) {
  for (const auto& [scene, angle, gain] :
       {Case{"fence", 8, 3}, Case{"foliage", 8, 2}, Case{"courtyard", 8, 2.5}, Case{"thesis", 2, 0.4},
        // Penumbrae as narrow as texels, and casters that the widest layer of the map misses.
        Case{"courtyard", 0.53f, 0.02}, Case{"fence", 0.53f, 0.13}, Case{"steps", 2, 0.3}}) {
    SceneRun run(scene, 320, 180);
    run.params().set("sun.angle", angle);
    const Visibility truth = run.draw_truth(256);
    const double pcss = penumbra_of_technique(run, truth, "pcss");
    const double here = penumbra_of_technique(run, truth, "backprojection");
    std::printf("%s, %g degrees: pcss %.1f dB, backprojection %.1f dB\n", scene, static_cast<double>(angle), pcss,
                here);
    EXPECT_GE(here, pcss + gain) << scene;
  }
}

}  // namespace
}  // namespace penumbra::test

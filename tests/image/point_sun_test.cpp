// A sun that is hardly wider than a point makes no penumbra, but what blocks it is as far away as under any other sun.

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"

namespace penumbra::test {
namespace {

class PointSunTest : public GpuTest {};

TEST_F(PointSunTest, BlockersAreAsFarWithADenoiserAsWithout) {
  SceneRun run("posts", 320, 180);
  run.choose("pcss");
  for (const float angle : {0.0f, 0.005f, 0.53f}) {
    run.params().set("sun.angle", angle);
    for (const bool tiles : {true, false}) {
      run.params().set("mask.tiles", tiles);
      run.params().set("denoiser", std::string("none"));
      const Visibility shadow = run.draw(/* cut= */ true);
      const std::vector<float> wanted = run.read_aov("blocker");
      run.params().set("denoiser", std::string("history_and_filters"));
      run.params().set("filter.visibility", std::string("bilateral"));
      run.draw(/* cut= */ true);
      const std::vector<float> found = run.read_aov("blocker");
      int dark = 0;
      for (std::size_t i = 0; i < shadow.size(); ++i) {
        if (shadow[i] != 0 || wanted[i] == 0) continue;
        ++dark;
        ASSERT_NEAR(found[i], wanted[i], 2e-3 * wanted[i])
            << "pixel " << i << ", " << angle << " degrees, tiles " << tiles;
      }
      EXPECT_GT(dark, 1000);
    }
  }
}

}  // namespace
}  // namespace penumbra::test

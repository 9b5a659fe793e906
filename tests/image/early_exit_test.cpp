// pcss.early_exit spares work and changes no result.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"
#include "support/alike.h"

namespace penumbra::test {
namespace {

using EarlyExit = GpuTest;

// The mask of the next frame, which starts without history.
std::vector<std::vector<float>> mask(SceneRun& run, bool early_exit) {
  run.params().set("pcss.early_exit", early_exit);
  const Picture visibility = run.draw(/*cut=*/true);
  return {visibility, run.read_aov("penumbra"), run.read_aov("blocker"), run.read_aov("under_texel")};
}

TEST_F(EarlyExit, ChangesNoResult) {
  for (const char* scene : {"steps", "fence", "foliage", "coincident", "curtain", "courtyard"}) {
    SceneRun run(scene, 160, 90);
    for (const std::string preset : {"pcss", "pcss_compute", "thesis_8x8"}) {
      for (const float angle : {0.0f, 0.53f, 2.0f, 8.0f}) {
        SCOPED_TRACE(fmt::format("{}, {}, {} degrees", scene, preset, angle));
        run.choose(preset);
        run.params().set("sun.angle", angle);
        const auto with = mask(run, true);
        const auto without = mask(run, false);
        expect_same_visibility(with[0], without[0], 16);
        if (gl::device_info().software) {
          EXPECT_EQ(with, without);
        }
        EXPECT_GT(std::count(with[0].begin(), with[0].end(), 1.0f), 100) << "few pixels are lit";
        EXPECT_GT(std::count_if(with[0].begin(), with[0].end(), [](float v) { return v >= 0 && v < 1; }), 100);
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::test

// The technique shadow_volume is the shadow of the sun's centre: the same as by rays, on whole scenes.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"

namespace penumbra::test {
namespace {

constexpr int width = 320, height = 180;

class ShadowVolumeImage : public GpuTest {};

// Of receivers whose shadow differs from that by rays: those too dark, those too bright, and those of both around which
// all rays agree with each other.
struct Differences {
  int receivers = 0, darker = 0, brighter = 0, off_edge = 0;

  double share() const { return static_cast<double>(darker + brighter) / receivers; }
};

// What rays to the sun's centre say of the pixels, rows from the top.
std::vector<bool> rays_of(const SceneRun& run) {
  std::vector<bool> lit;
  for (int y = height - 1; y >= 0; --y) {
    for (int x = 0; x < width; ++x)
      lit.push_back(run.traced().traced.hard[static_cast<std::size_t>(y * width + x)] > 0.5f);
  }
  return lit;
}

bool is_edge(const std::vector<bool>& lit, int x, int y) {
  const auto at = [&](int column, int row) { return lit[static_cast<std::size_t>(row * width + column)]; };
  for (int row = std::max(y - 1, 0); row <= std::min(y + 1, height - 1); ++row) {
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width - 1); ++column)
      if (at(column, row) != at(x, y)) return true;
  }
  return false;
}

Differences differences(SceneRun& run, const std::string& name) {
  run.choose("shadow_volume");
  run.params().set("sun.angle", 0.0f);  // so that all that faces the sun's centre counts as a receiver
  run.params().set("cascades.size", 16);
  const Visibility picture = run.draw(/*cut=*/true);
  run.draw_truth(8);
  const std::vector<bool> rays = rays_of(run);
  const std::vector<std::uint8_t> shown = run.receivers();
  Differences result;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<std::size_t>(y * width + x);
      if (shown[i] == 0) continue;
      ++result.receivers;
      if ((picture[i] > 0.5f) == rays[i]) continue;
      ++(rays[i] ? result.darker : result.brighter);
      result.off_edge += is_edge(rays, x, y) ? 0 : 1;
    }
  }
  std::printf("%s: of %d receivers %d darker, %d brighter; %d off edges\n", name.c_str(), result.receivers,
              result.darker, result.brighter, result.off_edge);
  return result;
}

// Where faces of several volumes meet within the rasteriser's 1/256 of a pixel their order is left to rounding, so
// single pixels may also differ beside the edges of lit triangles.
constexpr int most_off_edges = 3;

void expect_same(SceneRun& run, const std::string& name) {
  const Differences found = differences(run, name);
  EXPECT_GT(found.receivers, width * height / 20) << name;
  EXPECT_LE(found.share(), 0.001) << name;
  EXPECT_LE(found.off_edge, most_off_edges) << name;
}

TEST_F(ShadowVolumeImage, IsTheSameAsByRaysOnAllScenesWithoutAlphaMasks) {
  for (const char* scene :
       {"knife_edge", "posts", "steps", "thesis", "moving", "fence", "coincident", "tent", "curtain"}) {
    SceneRun run(scene, width, height);
    expect_same(run, scene);
  }
}

TEST_F(ShadowVolumeImage, FollowsSkinsAndMorphTargets) {
  SceneRun run("moving", width, height);
  for (const double time : {0.4, 1.1, 2.3}) {
    run.time() = time;
    expect_same(run, fmt::format("moving at {} s", time));
  }
}

TEST_F(ShadowVolumeImage, IsTheSameAsByRaysOnThirdPartiesScenes) {
  const char* assets = std::getenv("PENUMBRA_ASSETS");
  if (assets == nullptr) GTEST_SKIP() << "skipped: PENUMBRA_ASSETS is not set";
  for (const char* name : {"living_room/living_room", "robot/robot", "turbine/turbine", "town_house/town_house",
                           "zdm2/zdm2", "ferris_wheel/ferris-wheel", "NegativeScaleTest/NegativeScaleTest"}) {
    const std::filesystem::path scene = std::filesystem::absolute(assets) / "scenes" / name;
    if (!std::filesystem::exists(scene.string() + ".glb")) {
      std::printf("%s is absent\n", name);
      continue;
    }
    SceneRun run(scene.string(), width, height);
    expect_same(run, name);
  }
}

// The triangles of leaves count as whole, so that pixels are too dark, and none too bright.
TEST_F(ShadowVolumeImage, TakesAlphaMaskedTrianglesForWhole) {
  for (const char* scene : {"courtyard", "foliage"}) {
    SceneRun run(scene, width, height);
    const Differences found = differences(run, scene);
    EXPECT_LE(found.brighter, 0.0005 * found.receivers) << scene;
    EXPECT_GT(found.darker, 0.01 * found.receivers) << scene;
  }
}

}  // namespace
}  // namespace penumbra::test

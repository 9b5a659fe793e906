// How near the presets of few taps come to the preset of many, and that both drivers draw the same.

#include <gtest/gtest.h>

#include <cstdio>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"

namespace penumbra::test {
namespace {

class PresetQuality : public GpuTest {};

struct Quality {
  double raw = 0, filtered = 0;  // RMSE in the penumbra
};

// 8/8 taps, before and after the filter.
Quality quality_of(SceneRun& run, const std::string& pattern, const std::string& noise, int taps) {
  run.choose("thesis_8x8");
  run.params().set("pcss.blocker_taps", 8);
  run.params().set("pcss.filter_taps", taps);
  run.params().set("sampling.blocker_pattern", pattern);
  run.params().set("sampling.filter_pattern", pattern);
  run.params().set("sampling.noise", noise);
  const Picture reference = run.draw_reference();
  const std::vector<std::size_t> penumbra = penumbra_of(reference);
  const double filtered = rmse(run.draw(), reference, penumbra);
  run.params().set("filter.penumbra", std::string("none"));
  run.params().set("filter.visibility", std::string("none"));
  return {rmse(run.draw(), reference, penumbra), filtered};
}

TEST_F(PresetQuality, BlueNoiseIsNoWorseThanWhiteAndBetterTheFewerTheTaps) {
  SceneRun run("thesis", 480, 270);
  std::printf("RMSE and PSNR in the penumbra against brute_force, 8 blocker taps, thesis.glb, 480x270\n");
  for (const int taps : {8, 1}) {
    for (const std::string pattern : {"regular", "uniform", "poisson", "hammersley"}) {
      const Quality white = quality_of(run, pattern, "white", taps);
      const Quality blue = quality_of(run, pattern, "blue", taps);
      for (const auto& [noise, quality] : {std::pair("white", white), std::pair("blue", blue)}) {
        std::printf("%d taps, %-10s %-5s raw %.4f %.1f dB, filtered %.4f %.1f dB\n", taps, pattern.c_str(), noise,
                    quality.raw, decibels(quality.raw), quality.filtered, decibels(quality.filtered));
      }
      EXPECT_GE(decibels(blue.filtered), decibels(white.filtered)) << pattern << ", " << taps << " taps";
    }
  }
}

TEST_F(PresetQuality, EightTapsAndAFilterReach35Decibels) {
  SceneRun run("thesis", 640, 360);
  run.choose("thesis_8x8");
  const Picture reference = run.draw_reference();
  const double error = rmse(run.draw(), reference, penumbra_of(reference));
  std::printf("thesis_8x8: %.1f dB\n", decibels(error));
  EXPECT_GE(decibels(error), 35);
}

TEST_F(PresetQuality, BothDriversDrawTheSame) {
  for (const char* scene : {"thesis", "moving", "foliage"}) {
    SceneRun fragment(scene, 237, 131), compute(scene, 237, 131);
    for (const std::string preset : {"brute_force", "thesis", "thesis_8x8"}) {
      fragment.choose(preset);
      compute.choose(preset + "_compute");
      fragment.time() = compute.time() = 0;
      bool cut = true;
      for (int frame = 0; frame < 4; ++frame) {
        EXPECT_EQ(fragment.draw(cut), compute.draw(cut)) << scene << ", " << preset << ", frame " << frame;
        EXPECT_EQ(fragment.read_aov("penumbra"), compute.read_aov("penumbra"));
        EXPECT_EQ(fragment.read_aov("history"), compute.read_aov("history"));
        cut = false;
        fragment.time() = compute.time() += 1 / 30.0;
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::test

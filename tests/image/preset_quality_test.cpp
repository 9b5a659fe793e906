// How near the presets of few taps come to the preset of many, and that both drivers draw the same.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"
#include "support/alike.h"

namespace penumbra::test {
namespace {

class PresetQuality : public GpuTest {};

// Pictures of some seeds: how far they lie from the reference, and from their own mean, which is noise alone.
struct Quality {
  double error = 0, noise = 0;  // RMSE in the penumbra
};

Quality quality_of(SceneRun& run, const Visibility& reference) {
  constexpr int seeds = 4;
  const std::vector<std::size_t> penumbra = penumbra_of(reference);
  std::vector<Visibility> pictures;
  Visibility mean(reference.size(), 0.0f);
  double error = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    run.params().set("sampling.seed", seed);
    pictures.push_back(run.draw(/*cut=*/true));
    error += rmse(pictures.back(), reference, penumbra) / seeds;
    for (const std::size_t i : penumbra) mean[i] += pictures.back()[i] / seeds;
  }
  double noise = 0;
  for (const Visibility& picture : pictures) noise += std::pow(rmse(picture, mean, penumbra), 2);
  return {error, std::sqrt(noise / (seeds - 1))};
}

enum class Filtering { spaced, dense };

// thesis_8x8 under a pattern and a noise.
Quality quality_of(SceneRun& run, const Visibility& reference, const std::string& pattern, const std::string& noise,
                   Filtering filtering, int filter_taps) {
  run.choose("thesis_8x8");
  run.params().set("pcss.filter_taps", filter_taps);
  run.params().set("cascades.size", 1024);
  run.params().set("sampling.blocker_pattern", pattern);
  run.params().set("sampling.filter_pattern", pattern);
  run.params().set("sampling.noise", noise);
  if (filtering == Filtering::dense) run.params().set("filter.taps", 48);
  return quality_of(run, reference);
}

TEST_F(PresetQuality, BlueNoiseBeatsWhiteNoiseWhereTheFilterReadsEveryPixelAndIsNoWorseElse) {
  SceneRun run("thesis", 480, 270);
  run.choose("thesis_8x8");
  run.params().set("cascades.size", 1024);
  const Visibility reference = run.draw_reference();
  std::printf("penumbra of thesis.glb, 480x270, maps of 1024, 8 blocker taps: PSNR against brute_force after the ");
  std::printf("filter; noise alone after it, with 6 taps to a side and with all\n");
  for (const int taps : {8, 1}) {
    for (const std::string pattern : {"regular", "uniform", "poisson", "hammersley"}) {
      if (taps == 1 && pattern != "poisson") continue;  // a single point has no pattern
      double white_noise = 0, white_dense_noise = 0;
      for (const std::string noise : {"white", "blue"}) {
        const Quality filtered = quality_of(run, reference, pattern, noise, Filtering::spaced, taps);
        const Quality dense = quality_of(run, reference, pattern, noise, Filtering::dense, taps);
        std::printf("%d taps, %-10s %-5s RMSE %.4f %.1f dB; %.1f dB, %.1f dB\n", taps, pattern.c_str(), noise.c_str(),
                    filtered.error, decibels(filtered.error), decibels(filtered.noise), decibels(dense.noise));
        if (noise == "white") {
          white_noise = decibels(filtered.noise);
          white_dense_noise = decibels(dense.noise);
        } else {
          EXPECT_GE(decibels(filtered.noise), white_noise - 0.1) << pattern << ", " << taps << " taps";
          EXPECT_GE(decibels(dense.noise), white_dense_noise + (taps == 1 ? 4 : 0)) << pattern << ", " << taps;
        }
      }
    }
  }
}

TEST_F(PresetQuality, EightTapsAndAFilterReach35Decibels) {
  SceneRun run("thesis", 640, 360);
  run.choose("thesis_8x8");
  const double error = quality_of(run, run.draw_reference()).error;
  std::printf("thesis_8x8, thesis.glb, 640x360: %.1f dB\n", decibels(error));
  EXPECT_GE(decibels(error), 35);
}

// Where the mean over each column of a picture passes a level, pixels.
double crossing(const Visibility& picture, int width, double level) {
  std::vector<double> profile(static_cast<std::size_t>(width));
  const double rows = static_cast<double>(picture.size()) / width;
  for (std::size_t i = 0; i < picture.size(); ++i) profile[i % profile.size()] += picture[i] / rows;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const bool passes = (profile[i - 1] - level) * (profile[i] - level) <= 0;
    if (passes) return static_cast<double>(i - 1) + (level - profile[i - 1]) / (profile[i] - profile[i - 1]);
  }
  return std::nan("");
}

TEST_F(PresetQuality, EightTapsAndAFilterWidenAPenumbraByLittle) {
  SceneRun run("knife_edge", 480, 270, "top");
  run.choose("thesis_8x8");
  run.params().set("sun.angle", 2.0f);
  const auto width_of = [&](const Visibility& picture) {
    return std::abs(crossing(picture, run.width(), 0.9) - crossing(picture, run.width(), 0.1));
  };
  const double wanted = width_of(run.draw_reference());
  const double width = width_of(run.draw());
  std::printf("knife_edge.glb, 480x270: 10 to 90 %% in %.2f px, thesis_8x8 %.2f px\n", wanted, width);
  EXPECT_GT(wanted, 20);
  EXPECT_NEAR(width, wanted, 0.1 * wanted);
}

TEST_F(PresetQuality, BothDriversDrawTheSame) {
  for (const char* scene : {"thesis", "moving", "foliage"}) {
    SceneRun fragment(scene, 237, 131), compute(scene, 237, 131);
    for (const std::string preset : {"brute_force", "thesis", "thesis_8x8"}) {
      fragment.choose(preset);
      compute.choose(preset + "_compute");
      for (SceneRun* run : {&fragment, &compute}) run->params().set("cascades.size", 1024);
      fragment.time() = compute.time() = 0;
      bool cut = true;
      for (int frame = 0; frame < 4; ++frame) {
        SCOPED_TRACE(fmt::format("{}, {}, frame {}", scene, preset, frame));
        expect_same_visibility(fragment.draw(cut), compute.draw(cut), 8);
        if (gl::device_info().software) {
          EXPECT_EQ(fragment.read_aov("penumbra"), compute.read_aov("penumbra"));
          EXPECT_EQ(fragment.read_aov("history"), compute.read_aov("history"));
        }
        cut = false;
        fragment.time() = compute.time() += 1 / 30.0;
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::test

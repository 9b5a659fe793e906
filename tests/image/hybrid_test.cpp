// The technique hybrid: what the map decides is right, and rays mend the rest.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/scene_run.h"

namespace penumbra::test {
namespace {

class Hybrid : public GpuTest {};

std::vector<std::size_t> receivers_of(const SceneRun& run) {
  std::vector<std::size_t> receivers;
  const std::vector<std::uint8_t> shown = run.receivers();
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (shown[i] != 0) receivers.push_back(i);
  }
  return receivers;
}

double bias_of(const Visibility& picture, const Visibility& truth, const std::vector<std::size_t>& pixels) {
  double sum = 0;
  for (const std::size_t i : pixels) sum += static_cast<double>(picture[i]) - static_cast<double>(truth[i]);
  return sum / static_cast<double>(pixels.size());
}

Visibility draw(SceneRun& run, const char* technique, int rays = 16) {
  run.params().set("technique", std::string(technique));
  run.params().set("hybrid.rays", rays);
  return run.draw(/*cut=*/true);
}

TEST_F(Hybrid, IsNearerToTheTruthThanAnyTechniqueThatReadsTheMapAlone) {
  // `gain`: least, of 16 rays over pcss with 16/16 taps, dB over all receivers.
  struct Case {
    const char* scene;
    float angle;
    double gain;
  };
  for (const auto& [scene, angle, gain] : {Case{"posts", 0.53f, 10}, {"courtyard", 0.53f, 4}, {"foliage", 2, 4}}) {
    SceneRun run(scene, 320, 180);
    run.params().set("sun.angle", angle);
    const Visibility truth = run.draw_truth(256);
    const std::vector<std::size_t> receivers = receivers_of(run);
    const Visibility pcss = draw(run, "pcss"), hybrid = draw(run, "hybrid");
    const double of_pcss = decibels(rmse(pcss, truth, receivers)), of_hybrid = decibels(rmse(hybrid, truth, receivers));
    std::printf("%s, %g degrees: pcss %.1f dB, hybrid %.1f dB\n", scene, static_cast<double>(angle), of_pcss,
                of_hybrid);
    EXPECT_GE(of_hybrid, of_pcss + gain) << scene;
    EXPECT_LE(std::abs(bias_of(hybrid, truth, receivers)), 0.0005) << scene;
  }
}

// With many rays only the map's verdicts are left to differ from the truth.
TEST_F(Hybrid, LeavesToRaysWhatTheMapDoesNotShow) {
  for (const char* scene : {"posts", "steps", "fence"}) {
    SceneRun run(scene, 320, 180);
    run.params().set("sun.angle", 2.0f);
    const Visibility truth = run.draw_truth(1024), hybrid = draw(run, "hybrid", 1024);
    std::size_t wrong = 0;
    const std::vector<std::size_t> receivers = receivers_of(run);
    for (const std::size_t i : receivers) wrong += std::abs(hybrid[i] - truth[i]) > 0.1f ? 1 : 0;
    EXPECT_LE(static_cast<double>(wrong), 1e-3 * static_cast<double>(receivers.size())) << scene;
  }
}

// What a mask leaves of a leaf is often narrower than a texel, so that the map shows no edge there.
TEST_F(Hybrid, LosesNoMaskedCasterBetweenTexels) {
  SceneRun run("foliage", 640, 360);
  run.params().set("sun.angle", 0.53f);
  run.params().set("cascades.size", 256);
  const Visibility truth = run.draw_truth(512);
  const std::vector<std::size_t> receivers = receivers_of(run);
  const auto lost = [&](bool masked_casters) {
    run.params().set("hybrid.masked_casters", masked_casters);
    const Visibility picture = draw(run, "hybrid", 256);
    return std::ranges::count_if(receivers, [&](std::size_t i) { return std::abs(picture[i] - truth[i]) > 0.2f; });
  };
  const auto with = lost(true), without = lost(false);
  std::printf("pixels that are wrong by more than 0.2: with masked casters %td, without %td\n", with, without);
  EXPECT_EQ(with, 0);
  EXPECT_GE(without, 20) << "the scene no longer shows the fault";
}

// Denoisers need the blocker distances that the first rays find.
TEST_F(Hybrid, CanBeDenoised) {
  SceneRun run("fence", 320, 180);
  run.params().set("sun.angle", 8.0f);
  const Visibility truth = run.draw_truth(256);
  const std::vector<std::size_t> receivers = receivers_of(run);
  const double raw = decibels(rmse(draw(run, "hybrid"), truth, receivers));
  run.params().set("filter.visibility", std::string("bilateral_separable"));
  const Visibility picture = draw(run, "hybrid");
  const double denoised = decibels(rmse(picture, truth, receivers));
  std::printf("hybrid raw %.1f dB, denoised %.1f dB\n", raw, denoised);
  EXPECT_GE(denoised, raw + 5);
  EXPECT_LE(std::abs(bias_of(picture, truth, receivers)), 0.002);
}

// Narrow penumbrae beside wide ones too: a far caster shades all of `thesis` as well.
TEST_F(Hybrid, WithItsFilterIsFarNearerToTheTruth) {
  // dB over all receivers: at least this much more than without the filter, and at least this.
  struct Case {
    const char* scene;
    float angle;
    double gain, least;
  };
  for (const auto& [scene, angle, gain, least] : {Case{"fence", 0.53f, 4, 36.5}, Case{"thesis", 8, 13.5, 37}}) {
    SceneRun run(scene, 640, 360);
    run.params().set("sun.angle", angle);
    const Visibility truth = run.draw_truth(512);
    const std::vector<std::size_t> receivers = receivers_of(run);
    const double raw = decibels(rmse(draw(run, "hybrid"), truth, receivers));
    run.choose("hybrid_denoised");
    run.params().set("sun.angle", angle);
    const double denoised = decibels(rmse(run.draw(/*cut=*/true), truth, receivers));
    std::printf("%s, %g degrees: hybrid %.1f dB, hybrid_denoised %.1f dB\n", scene, static_cast<double>(angle), raw,
                denoised);
    EXPECT_GE(denoised, raw + gain) << scene;
    EXPECT_GE(denoised, least) << scene;
  }
}

TEST_F(Hybrid, TracesTwiceAsManyRaysWherePenumbraeAreNarrow) {
  SceneRun run("fence", 321, 180);
  run.params().set("sun.angle", 2.0f);
  const Visibility truth = run.draw_truth(1024);
  const std::vector<std::size_t> receivers = receivers_of(run);
  const auto error = [&](int rays, int narrow) {
    run.params().set("hybrid.narrow", narrow);
    return rmse(draw(run, "hybrid", rays), truth, receivers);
  };
  const double once = error(16, 0), some = error(16, 8), all = error(16, 64), twice = error(32, 0);
  std::printf("errors: 16 rays %.4f, 32 under 8 px %.4f, 32 under 64 px %.4f, 32 %.4f\n", once, some, all, twice);
  EXPECT_NEAR(all, twice, 0.05 * twice);
  EXPECT_NEAR(error(24, 64), error(48, 0), 0.1 * error(48, 0));  // no powers of two
  EXPECT_LT(all, 0.9 * some);
  EXPECT_LT(some, 0.95 * once);
}

TEST_F(Hybrid, DrawsTheSameEachTime) {
  SceneRun first("posts", 160, 90), second("posts", 160, 90);
  const Visibility once = draw(first, "hybrid");
  EXPECT_EQ(once, draw(first, "hybrid"));
  EXPECT_EQ(once, draw(second, "hybrid"));
}

// Samples of one picture and frames of a history differ by these.
TEST_F(Hybrid, OtherSeedsHaveOtherRays) {
  SceneRun run("posts", 160, 90);
  const Visibility first = draw(run, "hybrid");
  run.params().set("sampling.seed", 1);
  EXPECT_NE(draw(run, "hybrid"), first);
  run.params().set("sampling.seed", 0);
  run.params().set_text("sampling.filter_sequence", "shift");
  EXPECT_EQ(draw(run, "hybrid"), first);
  EXPECT_NE(run.draw(/*cut=*/false), first);
}

// Nothing moves but the sun's angle, so the tracer of the frame before serves again; a sky alone needs none.
TEST_F(Hybrid, FollowsItsParametersAndDrawsASky) {
  SceneRun run("posts", 160, 90);
  const Visibility narrow = draw(run, "hybrid");
  run.params().set("sun.angle", 8.0f);
  EXPECT_NE(draw(run, "hybrid"), narrow);
  run.camera().view = glm::mat4(1);
  run.camera().view[3] = glm::vec4(0, -1000, 0, 1);  // above all surfaces, looking ahead
  for (const float visibility : draw(run, "hybrid")) ASSERT_EQ(visibility, -1);
}

}  // namespace
}  // namespace penumbra::test

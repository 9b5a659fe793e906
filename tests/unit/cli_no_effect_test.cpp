#include "cli/no_effect.h"

#include <gtest/gtest.h>

#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra {
namespace {

// Why a parameter has no effect with a technique or preset, and with assignments besides.
std::string why(const std::string& name, const std::string& technique,
                const std::vector<std::string>& assignments = {}) {
  const shadow::Registry& registry = session::all_techniques();
  ParamSet params(render::Renderer::params(registry));
  registry.select(params, technique);
  for (const std::string& assignment : assignments) params.assign(assignment);
  return cli::why_without_effect(name, params, registry);
}

TEST(NoEffect, OfAnotherTechnique) {
  EXPECT_EQ(why("pcss.filter_taps", "slices"), "the technique slices does not read it");
  EXPECT_EQ(why("pcss.filter_taps", "thesis"), "");
  EXPECT_EQ(why("pcss.filter_taps", "ssss"), "") << "pcss shadows blended surfaces there";
}

TEST(NoEffect, OfAProductThatNothingReads) {
  EXPECT_NE(why("vsm.radius", "pcss"), "");
  EXPECT_EQ(why("vsm.radius", "vsm"), "");
  EXPECT_EQ(why("maps.layers", "slices"), "");
  EXPECT_NE(why("maps.layers", "pcss"), "");
}

TEST(NoEffect, OfTheSunsSize) {
  EXPECT_NE(why("sun.angle", "hard"), "");
  EXPECT_NE(why("sun.shape", "shadow_volume"), "");
  for (const char* technique : {"pcss", "truth", "hybrid", "slices_denoised"})
    EXPECT_EQ(why("sun.angle", technique), "");
}

TEST(NoEffect, WithoutAHistory) {
  EXPECT_EQ(why("history.alpha", "pcss"), "history.reuse is false");
  EXPECT_EQ(why("history.alpha", "thesis"), "");
  EXPECT_EQ(why("history.alpha", "thesis", {"denoiser=none"}), "denoiser is none");
  EXPECT_NE(why("history.alpha", "truth", {"history.reuse=on"}), "");
}

TEST(NoEffect, OfAFilterThatIsOff) {
  EXPECT_EQ(why("filter.taps", "pcss"), "filter.visibility is none");
  EXPECT_EQ(why("filter.taps", "thesis_8x8"), "");
  EXPECT_EQ(why("filter.edge", "thesis_8x8", {"filter.visibility=box"}), "filter.visibility is box");
}

TEST(NoEffect, OfWhatAMaskOfFewerPixelsDecides) {
  EXPECT_EQ(why("mask.tiles", "pcss"), "");
  EXPECT_EQ(why("mask.tiles", "slices_sparse"), "mask.scale is 2");
  EXPECT_EQ(why("filter.edge", "slices_sparse", {"filter.visibility=box"}), "");
  EXPECT_EQ(why("filter.edge", "slices_sparse", {"filter.visibility=box", "mask.scale=1"}), "filter.visibility is box");
  EXPECT_EQ(why("filter.edge", "slices_sparse", {"filter.visibility=none"}), "filter.visibility is none");
}

TEST(NoEffect, OfSplitsThatTheViewDecides) {
  EXPECT_EQ(why("cascades.split", "pcss"), "");
  EXPECT_EQ(why("cascades.split", "pcss", {"cascades.fit=visible"}), "cascades.fit is visible");
  EXPECT_EQ(why("cascades.split", "pcss", {"cascades.fit=penumbrae"}), "cascades.fit is penumbrae");
}

TEST(NoEffect, OfMapsThatMove) {
  EXPECT_EQ(why("maps.jitter", "pcss"), "");
  EXPECT_NE(why("maps.jitter", "none"), "");
  EXPECT_NE(why("sampling.seed", "hard"), "");
  EXPECT_EQ(why("sampling.seed", "hard", {"maps.jitter=on"}), "");
}

TEST(NoEffect, OfPatternsThatATechniqueHasItself) {
  EXPECT_EQ(why("sampling.filter_pattern", "pcss"), "");
  EXPECT_NE(why("sampling.filter_pattern", "brute_force"), "");
  EXPECT_NE(why("sampling.noise", "hard"), "");
  EXPECT_EQ(why("sampling.noise", "slices"), "");
}

TEST(NoEffect, NoParameterIsWithoutEffectEverywhere) {
  const shadow::Registry& registry = session::all_techniques();
  for (const std::string& name : ParamSet(render::Renderer::params(registry)).names()) {
    bool effective = false;
    for (const std::string& technique : registry.names()) {
      effective = effective || why(name, technique).empty() || why(name, technique, {"maps.layers=2"}).empty() ||
                  why(name, technique, {"exposure.auto=off"}).empty();
    }
    EXPECT_TRUE(effective) << name;
  }
}

}  // namespace
}  // namespace penumbra

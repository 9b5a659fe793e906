#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <stdexcept>

#include "core/error.h"
#include "shadow/registry.h"
#include "shadow/sampling.h"

namespace penumbra::shadow {
namespace {

Technique technique(const char* name) { return {.name = name, .glsl = "shadow/techniques/none.glsl"}; }

// The error of a registry with a valid technique and a changed copy of it; empty if the registry accepts both.
std::string complaint(const std::function<void(Technique&)>& change) {
  Technique changed = technique("changed");
  change(changed);
  try {
    const Registry registry({.techniques = {technique("good"), changed}});
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Registry, RefusesTechniquesThatCanNotBeEvaluated) {
  EXPECT_EQ(complaint([](Technique&) {}), "");
  EXPECT_EQ(complaint([](Technique& t) { t.name = "good"; }), "two techniques have the name 'good'");
  EXPECT_EQ(complaint([](Technique& t) { t.glsl = {}; }), "technique 'changed' has neither glsl nor resolve");
  const auto resolve = [](const PassContext&) {};
  EXPECT_EQ(complaint([&](Technique& t) {
              t.glsl = {};
              t.resolve = resolve;
            }),
            "technique 'changed' has neither glsl nor a stand_in");
  EXPECT_EQ(complaint([&](Technique& t) {
              t.glsl = {};
              t.resolve = resolve;
              t.stand_in = "good";
            }),
            "");
  EXPECT_EQ(complaint([&](Technique& t) {
              t.glsl = {};
              t.resolve = resolve;
              t.stand_in = "changed";
            }),
            "technique 'changed': its stand_in 'changed' has no glsl");
  EXPECT_EQ(complaint([](Technique& t) { t.stand_in = "god"; }), "unknown technique 'god'; did you mean 'good'?");
}

TEST(Registry, RefusesNamesThatAreNoIdentifiers) {
  for (const char* name : {"", "2", "my-shadow", "Pcss", "a b", "a/b"}) {
    EXPECT_EQ(
        complaint([&](Technique& t) { t.name = name; }),
        fmt::format("'{}' can't be the name of a technique or preset: not lower-case letters, digits and _", name));
  }
  Recipe with_space = {.name = "moments 4"};
  EXPECT_THROW(Registry({.techniques = {technique("good")}, .recipes = {with_space}}), Error);
}

TEST(Registry, RefusesAParameterThatTwoDeclare) {
  EXPECT_EQ(complaint([](Technique& t) {
              t.params = {{"history.alpha", 1, 0, 4, "", "Twice."}};
            }),
            "two parameters have the name 'history.alpha'");
}

TEST(Registry, KnowsWhichParametersConcernATechnique) {
  Technique one = technique("one"), two = technique("two");
  one.params = {{"shared.points", 1, 1, 4, "taps", "How many."}, {"two.sharpness", 1, 1, 4, "", "How sharp."}};
  two.params = {{"one.width", 1, 1, 4, "", "How wide."}};
  two.samples = {{.name = "around", .count_parameter = "shared.points"}};
  const Registry registry({.techniques = {one, two}});
  ParamSet params(registry.params());
  for (const char* name : {"shared.points", "two.sharpness", "sun.angle"}) EXPECT_TRUE(registry.concerns(name, params));
  EXPECT_FALSE(registry.concerns("one.width", params)) << "the owner lists it, whatever its name";
  params.set("technique", std::string("two"));
  EXPECT_TRUE(registry.concerns("one.width", params));
  EXPECT_FALSE(registry.concerns("two.sharpness", params));
  EXPECT_TRUE(registry.concerns("shared.points", params)) << "it counts a sample set";
  EXPECT_TRUE(registry.concerns("history.alpha", params));
  params.set("denoiser", std::string("none"));
  EXPECT_FALSE(registry.concerns("history.alpha", params));
}

TEST(Registry, RefusesUnknownPatternsAndScrambles) {
  EXPECT_EQ(complaint([](Technique& t) { t.pattern = "vogle"; }),
            "unknown pattern of technique 'changed' 'vogle'; did you mean 'vogel'?");
  EXPECT_EQ(complaint([](Technique& t) { t.scramble = "rotat"; }),
            "unknown scramble of technique 'changed' 'rotat'; did you mean 'rotate'?");
  EXPECT_EQ(complaint([](Technique& t) {
              t.pattern = "halton";
              t.scramble = "shift";
            }),
            "");
  EXPECT_THROW(square_points("vogle", 4), Error);
}

TEST(Registry, RefusesPresetsAndDefaultsOfNothing) {
  EXPECT_THROW(Registry({.techniques = {}}), Error);
  EXPECT_THROW(Registry({.techniques = {technique("good")}, .default_technique = "bad"}), Error);
  EXPECT_THROW(Registry({.techniques = {technique("good")}, .presets = {{"preset", "bad", "", {}}}}), Error);
  EXPECT_THROW(Registry({.techniques = {technique("good")}, .presets = {{"good", "good", "", {}}}}), Error);
}

// A technique with a sample set and a parameter that counts its points, up to a maximum.
void with_points(Technique& technique, int most) {
  technique.params = {{"changed.points", std::min(1, most), 0, static_cast<double>(most), "taps", "How many."}};
  technique.samples = {{.name = "around", .count_parameter = "changed.points"}};
}

TEST(Registry, RefusesSampleSetsThatDoNotFitIntoTheirTables) {
  EXPECT_EQ(complaint([](Technique& t) { with_points(t, 256); }), "");
  EXPECT_EQ(complaint([](Technique& t) { with_points(t, 512); }),
            "technique 'changed': the sample set 'around' may have 512 points by 'changed.points'; 256 fit");
  EXPECT_EQ(complaint([](Technique& t) {
              with_points(t, 256);
              for (const char* name : {"b", "c", "d"}) t.samples.push_back({name, "changed.points"});
            }),
            "");
  EXPECT_EQ(complaint([](Technique& t) {
              with_points(t, 256);
              for (const char* name : {"b", "c", "d", "e"}) t.samples.push_back({name, "changed.points"});
            }),
            "technique 'changed': its sample sets take 20480 bytes; a uniform block has 16384");
}

TEST(Registry, RefusesSampleSetsThatNothingCounts) {
  EXPECT_EQ(complaint([](Technique& t) { t.samples = {{.name = "around", .count_parameter = "changed.points"}}; }),
            "technique 'changed': the sample set 'around' is counted by 'changed.points', which is no parameter");
  EXPECT_EQ(complaint([](Technique& t) { t.samples = {{.name = "around", .count_parameter = "sun.angle"}}; }),
            "technique 'changed': the sample set 'around' is counted by 'sun.angle', which is no number of points");
  EXPECT_EQ(
      complaint([](Technique& t) { with_points(t, 0); }),
      "technique 'changed': the sample set 'around' is counted by 'changed.points', which is no number of points");
  EXPECT_EQ(complaint([](Technique& t) { t.samples = {{.name = "2", .count_parameter = "sampling.seed"}}; }),
            "technique 'changed': '2' can't be the name of a sample set in GLSL");
  EXPECT_EQ(complaint([](Technique& t) {
              with_points(t, 4);
              t.samples.push_back(t.samples[0]);
            }),
            "two sample sets of technique 'changed' have the name 'around'");
}

const gl::Texture& make_nothing(const PassContext& /*context*/) { throw std::logic_error("never made"); }

Recipe recipe(const char* name, std::vector<std::string> needs = {}) {
  return {.name = name, .needs = std::move(needs), .build = make_nothing};
}

// The error of a registry with these recipes and a technique that needs the named ones; empty if it accepts them.
std::string complaint(std::vector<Recipe> recipes, std::vector<std::string> needs) {
  Technique asking = technique("asking");
  asking.needs = std::move(needs);
  try {
    const Registry registry({.techniques = {asking}, .recipes = std::move(recipes)});
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Registry, RefusesProductsThatNothingMakes) {
  EXPECT_EQ(complaint({recipe("first"), recipe("second", {"shadow_map", "first"})}, {"second"}), "");
  EXPECT_EQ(complaint({recipe("first")}, {"frist"}),
            "unknown product that technique 'asking' needs 'frist'; did you mean 'first'?");
  EXPECT_EQ(complaint({recipe("second", {"first"}), recipe("first")}, {}),
            "unknown product that recipe 'second' needs 'first'; known: shadow_map");
  EXPECT_EQ(complaint({recipe("first"), recipe("first")}, {}), "two recipes have the name 'first'");
  EXPECT_EQ(complaint({recipe("shadow_map")}, {}),
            "a recipe can't have the name 'shadow_map': the library draws that map");
  EXPECT_EQ(complaint({{.name = "first"}}, {}), "recipe 'first' has no build");
  EXPECT_EQ(complaint({recipe("a"), recipe("b"), recipe("c"), recipe("d"), recipe("e")}, {"a", "b", "c", "d", "e"}),
            "technique 'asking' needs 5 products; there are texture units for 4");
}

TEST(Registry, RefusesTechniquesThatDecideTilesWithoutWhatThatTakes) {
  const auto complain = [](const std::vector<std::string>& needs, const std::string& glsl) -> std::string {
    Technique decides = technique("quick");
    decides.needs = needs;
    decides.glsl = glsl;
    decides.decides_tiles = true;
    decides.resolve = [](const PassContext&) {};
    decides.stand_in = "good";
    try {
      const Registry registry({.techniques = {technique("good"), std::move(decides)}});
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(complain({"shadow_map", "least_depth_pyramid"}, "quick.glsl"), "");
  EXPECT_EQ(complain({"shadow_map"}, "quick.glsl"),
            "technique 'quick' decides tiles, for which it needs 'least_depth_pyramid'");
  EXPECT_EQ(complain({"shadow_map", "least_depth_pyramid"}, ""),
            "technique 'quick' decides tiles, for which it needs glsl");
}

TEST(Registry, RefusesDenoisersThatCanNotRun) {
  const auto complain = [](Denoiser denoiser) -> std::string {
    try {
      const Registry registry({.techniques = {technique("good")}, .denoisers = {std::move(denoiser)}});
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  const auto nothing = [](const DenoiseContext&) {};
  EXPECT_EQ(complain({.name = "blur", .denoise = nothing}), "");
  EXPECT_EQ(complain({.name = "blur"}), "denoiser 'blur' has no denoise");
  EXPECT_EQ(complain({.name = "none", .denoise = nothing}), "a denoiser can't have the name 'none'");
  EXPECT_EQ(complain({.name = "blur", .needs = {"moments"}, .denoise = nothing}),
            "unknown product that denoiser 'blur' needs 'moments'; known: shadow_map, compared_depth, "
            "least_depth_pyramid, greatest_depth_pyramid, depth_sums, second_layer, "
            "movement_map");
}

TEST(Registry, TheDenoiserIsAParameterWithNearNames) {
  ParamSet params(built_in_registry().params());
  EXPECT_EQ(params.get_word("denoiser"), "history_and_filters");
  params.assign("denoiser=none");
  try {
    params.assign("denoiser=history_and_filter");
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("history_and_filters"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace penumbra::shadow

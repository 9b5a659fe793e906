#include <gtest/gtest.h>

#include <functional>

#include "core/error.h"
#include "shadow/sampling.h"
#include "shadow/technique.h"

namespace penumbra::shadow {
namespace {

Technique technique(const char* name) { return {.name = name, .glsl = "shadow/techniques/none.glsl"}; }

// What a registry of a good technique and one that was changed says; empty: it is taken.
std::string complaint(const std::function<void(Technique&)>& change) {
  Technique changed = technique("changed");
  change(changed);
  try {
    const Registry registry({technique("good"), changed}, {});
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

TEST(Registry, RefusesTechniquesThatCanNotBeEvaluated) {
  EXPECT_EQ(complaint([](Technique&) {}), "");
  EXPECT_EQ(complaint([](Technique& t) { t.name = "good"; }), "two techniques have the name 'good'");
  EXPECT_EQ(complaint([](Technique& t) { t.glsl = {}; }), "technique 'changed' has neither glsl nor resolve");
  const auto resolve = [](const TechniqueFrame&) {};
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

TEST(Registry, RefusesAliasesAndDefaultsOfNothing) {
  EXPECT_THROW(Registry({}, {}), Error);
  EXPECT_THROW(Registry({technique("good")}, {}, "bad"), Error);
  EXPECT_THROW(Registry({technique("good")}, {{"alias", "bad", "", {}}}), Error);
  EXPECT_THROW(Registry({technique("good")}, {{"good", "good", "", {}}}), Error);
}

}  // namespace
}  // namespace penumbra::shadow

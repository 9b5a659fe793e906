// What a frame in motion draws less of.
#include "viewer/detail.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "render/renderer.h"
#include "session/techniques.h"

namespace penumbra {
namespace {

using viewer::Detail;
using viewer::effective;
using viewer::reduced;

ParamSet of(const std::string& technique) {
  ParamSet params(render::Renderer::params(session::all_techniques()));
  session::all_techniques().select(params, technique);
  return params;
}

TEST(ViewerDetail, TheFullOneIsWhatTheDocumentAsksFor) {
  for (const char* technique : {"slices_denoised", "pcss", "truth", "none"})
    EXPECT_EQ(reduced(of(technique), {}), of(technique)) << technique;
  EXPECT_EQ(reduced(of("pcss"), {.picture = 8}), of("pcss"));
}

TEST(ViewerDetail, MapsAreFewerAndSmallerAndNothingElseIs) {
  const ParamSet params = of("slices_denoised");
  for (const int divisor : {2, 4}) {
    const ParamSet fewer = reduced(params, {.maps = divisor});
    for (const Param& row : params.rows()) {
      const bool same = fewer.value(row.name) == params.value(row.name);
      EXPECT_EQ(same, row.name != "cascades.size" && row.name != "cascades.count") << row.name;
    }
    EXPECT_EQ(fewer.get_int("cascades.count"), params.get_int("cascades.count") / divisor);
    EXPECT_EQ(fewer.get_int("cascades.size"), params.get_int("cascades.size") / 2);
  }
}

TEST(ViewerDetail, MapsCostLessFromLevelToLevel) {
  for (int count = 1; count <= 8; ++count) {
    ParamSet params = of("slices_denoised");
    params.set("cascades.count", count);
    int last_count = count, last_size = params.get_int("cascades.size");
    for (const int divisor : {2, 4}) {
      const ParamSet fewer = reduced(params, {.maps = divisor});
      EXPECT_LE(fewer.get_int("cascades.count"), last_count) << count;
      EXPECT_LE(fewer.get_int("cascades.size"), last_size) << count;
      last_count = fewer.get_int("cascades.count");
      last_size = fewer.get_int("cascades.size");
    }
    EXPECT_EQ(last_count, std::max(count / 4, 1));
    EXPECT_LT(last_size, params.get_int("cascades.size"));
  }
}

TEST(ViewerDetail, ReadsAreFewerForTheTechniqueThatIsShownAlone) {
  const ParamSet slices = reduced(of("slices_denoised"), {.reads = 4});
  EXPECT_EQ(slices.get_int("slices.azimuths"), 3);
  EXPECT_EQ(slices.get_int("slices.samples"), 4);
  EXPECT_TRUE(slices.is_default("pcss.filter_taps"));
  const ParamSet pcss = reduced(of("pcss"), {.reads = 4});
  EXPECT_EQ(pcss.get_int("pcss.filter_taps"), 4);
  EXPECT_EQ(pcss.get_int("pcss.blocker_taps"), 4);
  EXPECT_TRUE(pcss.is_default("slices.samples"));
  EXPECT_TRUE(pcss.is_default("cascades.size"));
  EXPECT_EQ(reduced(of("brute_force"), {.reads = 4}).get_int("brute_force.filter_taps"), 64);
}

TEST(ViewerDetail, WhatIsSmallAlreadyStays) {
  ParamSet params = of("pcss");
  params.set("cascades.size", 300);
  params.set("pcss.filter_taps", 7);
  params.set("pcss.blocker_taps", 1);
  const ParamSet fewer = reduced(params, {.maps = 4, .reads = 4});
  EXPECT_EQ(fewer.get_int("cascades.size"), 256);
  EXPECT_EQ(fewer.get_int("pcss.filter_taps"), 4);
  EXPECT_EQ(fewer.get_int("pcss.blocker_taps"), 1);
  params.set("cascades.size", 64);
  EXPECT_EQ(reduced(params, {.maps = 4}).get_int("cascades.size"), 64);
}

TEST(ViewerDetail, EveryTechniqueTakesTheReducedValues) {
  for (const auto& technique : session::all_techniques().techniques()) {
    const ParamSet params = of(technique.name), fewer = reduced(params, {.maps = 4, .reads = 4});
    for (const Param& row : params.rows()) {
      ParamSet again = params;
      EXPECT_NO_THROW(again.assign(row.name + "=" + to_text(fewer.value(row.name)))) << technique.name;
    }
  }
}

TEST(ViewerDetail, OnlyWhatShrinksIsShown) {
  const Detail least{.picture = 8, .maps = 4, .reads = 4};
  EXPECT_EQ(effective(of("slices_denoised"), least), least);
  EXPECT_EQ(effective(of("pcss"), least), least);
  EXPECT_EQ(effective(of("pcf_tent"), least), (Detail{.picture = 8, .maps = 4}));
  EXPECT_EQ(effective(of("truth"), least), (Detail{.picture = 8}));
  ParamSet small = of("pcss");
  small.set("cascades.size", 256);
  small.set("cascades.count", 1);
  EXPECT_EQ(effective(small, least), (Detail{.picture = 8, .reads = 4}));
  EXPECT_EQ(effective(of("pcss"), {}), Detail{});
}

TEST(ViewerDetail, TheTruthIsTheTruth) {
  EXPECT_EQ(reduced(of("truth"), {.picture = 8, .maps = 4, .reads = 4}), of("truth"));
}

}  // namespace
}  // namespace penumbra

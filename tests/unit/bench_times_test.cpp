#include <gtest/gtest.h>

#include "bench/times.h"

namespace penumbra::test {
namespace {

using bench::Cost;
using bench::PassTimes;
using gl::Timers;

// Two frames of warm-up, then two that count.
std::vector<Timers::Row> rows(double mask) {
  return {{"gbuffer", {9, 9, 2, 2}},           {"shadow map", {9, 9, 1, 3}}, {"shadow map/cascade", {9, 9, 1, 3}},
          {"shadow mask", {9, 9, mask, mask}}, {"median", {9, 9, 0, 0}},     {"frame", {50, 50, 4 + mask, 6 + mask}}};
}

PassTimes times_of(double mask) {
  PassTimes times;
  times.append(rows(mask), {7, 7, 1, 2}, 2);
  return times;
}

TEST(PassTimes, LeaveOutWarmUpAndPassesThatDidNotRun) {
  const PassTimes times = times_of(4);
  EXPECT_EQ(times.frames, (std::vector<double>{8, 10}));
  EXPECT_EQ(times.of("shadow map"), (std::vector<double>{1, 3}));
  EXPECT_EQ(times.of("median"), (std::vector<double>{0, 0}));
  for (const Timers::Row& pass : times.passes) EXPECT_NE(pass.name, "median");
}

TEST(PassTimes, CountAPassWithinAnotherOnce) {
  const PassTimes times = times_of(4);
  EXPECT_EQ(times.sums(), (std::vector<double>{7, 9}));
  EXPECT_EQ(times.shadow_sums(), (std::vector<double>{5, 7}));
}

TEST(PassTimes, OfChosenFrames) {
  const std::vector<std::size_t> indices{1, 3};
  const PassTimes times = PassTimes::of_frames(rows(4), indices);
  EXPECT_EQ(times.frames, (std::vector<double>{50, 10}));
  EXPECT_EQ(times.shadow_sums(), (std::vector<double>{27, 7}));
}

// A pass that only one visit drew has zeros for the frames of the others, so that frames stay in step.
TEST(PassTimes, OfSeveralVisitsStayInStep) {
  PassTimes times = times_of(4);
  times.append({{"median", {6}}, {"shadow mask", {5}}, {"frame", {12}}}, {3}, 1);
  times.append(rows(4), {7, 7, 1, 2}, 2);
  EXPECT_EQ(times.frames.size(), 5U);
  EXPECT_EQ(times.cpu, (std::vector<double>{1, 2, 3, 1, 2}));
  EXPECT_EQ(times.of("median"), (std::vector<double>{0, 0, 6, 0, 0}));
  EXPECT_EQ(times.of("gbuffer"), (std::vector<double>{2, 2, 0, 2, 2}));
  EXPECT_EQ(times.sums(), (std::vector<double>{7, 9, 11, 7, 9}));
}

TEST(Cost, ComparesFrameByFrame) {
  const Cost cost = bench::cost_of(times_of(8), times_of(3));
  EXPECT_DOUBLE_EQ(cost.shadow.median, 10);
  EXPECT_DOUBLE_EQ(cost.cpu.median, 1.5);
  EXPECT_DOUBLE_EQ(cost.of_first, 0.5 * (9.0 / 4 + 11.0 / 6));
  EXPECT_EQ(cost.passes.front().name, "gbuffer");
  EXPECT_FALSE(cost.passes.front().shadow);
  EXPECT_DOUBLE_EQ(cost.passes.front().share, 2.0 / 13);
}

// A map that one frame of four draws: its median is that of this frame, its share and its bar are of all four.
TEST(Cost, OfAPassThatFewFramesDrewIsSpreadOverAll) {
  PassTimes times;
  times.append({{"shadow map", {0, 0, 8, 0}}, {"shadow mask", {2, 2, 2, 2}}, {"frame", {2, 2, 10, 2}}}, {1, 1, 1, 1},
               4);
  const Cost cost = bench::cost_of(times, times);
  const bench::PassCost &map = cost.passes[0], &mask = cost.passes[1];
  EXPECT_DOUBLE_EQ(map.ms.median, 8);
  EXPECT_EQ(map.ms.count, 1U);
  EXPECT_DOUBLE_EQ(map.share, 0.5);
  EXPECT_DOUBLE_EQ(cost.per_frame(map), 2);
  EXPECT_DOUBLE_EQ(mask.share, 0.5);
  EXPECT_DOUBLE_EQ(cost.per_frame(mask), 2);
}

TEST(Cost, SaysWhetherThePassesAddUp) {
  EXPECT_FALSE(bench::cost_of(times_of(4), times_of(4)).adds_up());  // 7 of 8, 9 of 10
  EXPECT_TRUE(bench::cost_of(times_of(20), times_of(20)).adds_up());
}

TEST(Cost, KnowsTheRenderersOwnPasses) {
  for (const char* name : {"depth", "gbuffer", "lighting", "sky", "tone map", "exposure", "blended"})
    EXPECT_FALSE(bench::is_shadow_pass(name)) << name;
  for (const char* name : {"shadow map", "shadow map/cascade", "filter", "shadow history", "anything new"})
    EXPECT_TRUE(bench::is_shadow_pass(name)) << name;
}

}  // namespace
}  // namespace penumbra::test

// The costs that the viewer shows. tests/gpu/viewer_cost_reader_test.cpp tests how the times are read.
#include "viewer/costs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

namespace penumbra {
namespace {

using viewer::Costs;

double median_of(const Costs& costs, const std::string& name) {
  for (const Costs::Pass& pass : costs.passes()) {
    if (pass.name == name) return pass.median;
  }
  ADD_FAILURE() << "no pass " << name;
  return -1;
}

TEST(ViewerCosts, NothingWasMeasuredYet) {
  const Costs costs;
  EXPECT_TRUE(costs.passes().empty());
  EXPECT_EQ(costs.frame(), 0);
  EXPECT_TRUE(costs.history().empty());
}

TEST(ViewerCosts, MediansShrugOffAFrameThatStumbled) {
  Costs costs;
  for (int i = 0; i < 9; ++i) costs.add(0.1 * i, {{"shadow", i == 4 ? 900.0 : 2.0}, {"frame", i == 4 ? 905.0 : 5.0}});
  EXPECT_EQ(median_of(costs, "shadow"), 2.0);
  EXPECT_EQ(costs.frame(), 5.0);
}

TEST(ViewerCosts, OnlyTheLastSecondCounts) {
  Costs costs;
  for (int i = 0; i < 100; ++i) costs.add(0.01 * i, {{"shadow", 50.0}, {"frame", 60.0}});
  for (int i = 0; i < 4; ++i) costs.add(2.0 + 0.2 * i, {{"shadow", 1.0}, {"frame", 2.0}});
  EXPECT_EQ(median_of(costs, "shadow"), 1.0);
  EXPECT_EQ(costs.frame(), 2.0);
}

TEST(ViewerCosts, AFrameThatTookLongerIsSeenAllTheSame) {
  Costs costs;
  costs.add(0, {{"truth", 10.0}, {"frame", 10.0}});
  costs.add(7, {{"truth", 6900.0}, {"frame", 6950.0}});
  EXPECT_EQ(median_of(costs, "truth"), 6900.0);
  EXPECT_EQ(costs.frame(), 6950.0);
}

TEST(ViewerCosts, TheDearestPassComesFirstAndPartsCountInTheirWhole) {
  Costs costs;
  costs.add(0, {{"a", 1.0}, {"b", 3.0}, {"b/part", 2.9}, {"c", 2.0}, {"frame", 7.0}});
  std::vector<std::string> names;
  for (const Costs::Pass& pass : costs.passes()) names.push_back(pass.name);
  EXPECT_EQ(names, (std::vector<std::string>{"b", "c", "a"}));
}

TEST(ViewerCosts, APassThatFewFramesDrawCostsLittle) {
  Costs costs;
  for (int i = 0; i < 10; ++i) {
    std::map<std::string, double> passes{{"always", 1.0}, {"frame", 9.0}};
    if (i == 9) passes["rarely"] = 8.0;
    costs.add(0.05 * i, passes);
  }
  EXPECT_EQ(median_of(costs, "rarely"), 0.0);
  EXPECT_EQ(median_of(costs, "always"), 1.0);
}

TEST(ViewerCosts, ClearedCostsSayNothingOfWhatWasBefore) {
  Costs costs;
  for (int i = 0; i < 5; ++i) costs.add(0.1 * i, {{"old", 50.0}, {"frame", 60.0}});
  costs.clear();
  EXPECT_TRUE(costs.passes().empty());
  EXPECT_EQ(costs.frame(), 0);
  costs.add(0.6, {{"new", 1.0}, {"frame", 2.0}});
  EXPECT_EQ(costs.frame(), 2.0);
  EXPECT_EQ(costs.passes().size(), 1u);
}

TEST(ViewerCosts, TheHistoryIsTheLastFramesInOrder) {
  Costs costs;
  for (int i = 0; i < 1000; ++i) costs.add(i, {{"frame", static_cast<double>(i)}});
  const std::vector<float>& history = costs.history();
  ASSERT_FALSE(history.empty());
  EXPECT_LE(history.size(), 240u);
  EXPECT_EQ(history.back(), 999.0f);
  EXPECT_TRUE(std::is_sorted(history.begin(), history.end()));
  EXPECT_EQ(history.back() - history.front(), static_cast<float>(history.size() - 1)) << "frames are missing";
}

}  // namespace
}  // namespace penumbra

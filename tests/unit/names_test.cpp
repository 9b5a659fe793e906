#include "core/names.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace penumbra {
namespace {

const std::vector<std::string> techniques{"none", "hard", "pcf", "pcss", "pcss_compute", "brute_force"};
const std::vector<std::string> params{"pcss.filter_taps", "pcss.blocker_taps", "sun.angle", "cascades.count"};

std::string message(std::string_view kind, std::string_view name, const std::vector<std::string>& candidates) {
  try {
    fail_unknown(kind, name, candidates);
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Names, AMisspeltNameFindsItsOwnFirst) {
  EXPECT_EQ(near_names("psss", techniques).front(), "pcss");
  EXPECT_EQ(near_names("brute_forse", techniques).front(), "brute_force");
  EXPECT_EQ(near_names("sun.angel", params).front(), "sun.angle");
}

TEST(Names, SwappedNeighboursAreOneEdit) {
  EXPECT_EQ(near_names("pfc", techniques).front(), "pcf");
  EXPECT_EQ(near_names("hrad", techniques).front(), "hard");
}

TEST(Names, TheSameLettersInAnotherOrderAreNear) {
  EXPECT_EQ(near_names("pscc", techniques), std::vector<std::string>{"pcss"});
  EXPECT_TRUE(near_names("abcd", techniques).empty());
}

TEST(Names, CaseDoesNotCount) { EXPECT_EQ(near_names("PCSS", techniques).front(), "pcss"); }

TEST(Names, APartOfANameFindsTheWhole) {
  EXPECT_EQ(near_names("filter_taps", params).front(), "pcss.filter_taps");
  EXPECT_EQ(near_names("count", params), std::vector<std::string>{"cascades.count"});
}

TEST(Names, AtMostThreeAreOffered) {
  const std::vector<std::string> many{"cube1", "cube2", "cube3", "cube4"};
  EXPECT_EQ(near_names("cube", many).size(), 3u);
}

TEST(Names, NothingIsNearToNonsense) { EXPECT_TRUE(near_names("quux_zap", techniques).empty()); }

TEST(Names, TheErrorOffersWhatIsNear) {
  EXPECT_EQ(message("technique", "hart", techniques), "unknown technique 'hart'; did you mean 'hard'?");
}

TEST(Names, TheErrorListsAllWhenNothingIsNear) {
  EXPECT_EQ(message("technique", "zzzzzzz", techniques),
            "unknown technique 'zzzzzzz'; known: none, hard, pcf, pcss, pcss_compute, brute_force");
}

TEST(Names, AnEmptyNameIsUnknownToo) {
  EXPECT_NE(message("technique", "", techniques).find("unknown technique ''"), std::string::npos);
}

}  // namespace
}  // namespace penumbra

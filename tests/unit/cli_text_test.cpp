#include "cli/text.h"

#include <gtest/gtest.h>

namespace {

using penumbra::cli::wrapped;

TEST(CliText, ShortLinesStayAsTheyAre) {
  const std::string text = "one  two\n\n  three\n";
  EXPECT_EQ(wrapped(text, 20), text);
}

TEST(CliText, LongLinesBreakAtTheLastSpaceThatFits) {
  EXPECT_EQ(wrapped("a line of many words", 10), "a line of\nmany words");
  EXPECT_EQ(wrapped("a line of many words", 12), "a line of\nmany words");
}

TEST(CliText, WhatFollowsABreakIsBelowItsColumn) {
  EXPECT_EQ(wrapped("  --size N  how wide it is, and how high\n", 24),
            "  --size N  how wide it\n            is, and how\n            high\n");
  EXPECT_EQ(wrapped("    words of an indented line", 20), "    words of an\n    indented line");
}

TEST(CliText, AWordIsNeverBroken) {
  EXPECT_EQ(wrapped("an_endless_word_of_many_letters and more", 10), "an_endless_word_of_many_letters\nand more");
}

TEST(CliText, LettersOfSeveralBytesAreOneColumn) { EXPECT_EQ(wrapped("ÄÄÄÄ ÖÖÖÖ ÜÜÜÜ", 9), "ÄÄÄÄ ÖÖÖÖ\nÜÜÜÜ"); }

// U+0080 to U+009F, of which U+009B begins a sequence for some terminals.
TEST(CliText, ControlCharactersBecomeSpaces) {
  EXPECT_EQ(penumbra::cli::printable("a\nb\x1b[2J\x7f"), "a b [2J ");
  EXPECT_EQ(penumbra::cli::printable("a\xc2\x9b"
                                     "2J\xc2\x80"),
            "a  2J  ");
  EXPECT_EQ(penumbra::cli::printable("\u00a0\u00e9\u2014\xc2"), "\u00a0\u00e9\u2014\xc2");
}

}  // namespace

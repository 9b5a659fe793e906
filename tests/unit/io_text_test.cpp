// Comma-separated values as spreadsheets read them, and lists as the command line takes them.
#include "io/text.h"

#include <gtest/gtest.h>

namespace penumbra::io {
namespace {

TEST(CsvField, IsQuotedOnlyWhereItMustBe) {
  EXPECT_EQ(csv_field(""), "");
  EXPECT_EQ(csv_field("pcss 16/16"), "pcss 16/16");
  EXPECT_EQ(csv_field("pcss:a=1,b=2"), "\"pcss:a=1,b=2\"");
  EXPECT_EQ(csv_field("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csv_field("two\nlines"), "\"two\nlines\"");
}

TEST(CsvField, IsUtf8) {
  EXPECT_EQ(csv_field("größe"), "größe");
  EXPECT_EQ(csv_field("gr\xf6\xdf"
                      "e"),
            "gr\xef\xbf\xbd\xef\xbf\xbd"
            "e");
  EXPECT_EQ(csv_field("\xf6,\"\xc3"), "\"\xef\xbf\xbd,\"\"\xef\xbf\xbd\"");
}

TEST(Split, KeepsWhatIsEmpty) {
  using Parts = std::vector<std::string>;
  EXPECT_EQ(split("", ','), Parts{""});
  EXPECT_EQ(split("a", ','), Parts{"a"});
  EXPECT_EQ(split("a,,b,", ','), (Parts{"a", "", "b", ""}));
  EXPECT_EQ(split("1:2", ':'), (Parts{"1", "2"}));
}

}  // namespace
}  // namespace penumbra::io

#include "report/html.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "report/number.h"
#include "report/page.h"
#include "report/picture.h"
#include "report/text_blocks.h"

namespace penumbra::report {
namespace {

std::string base64_of(std::string_view text) { return base64(std::as_bytes(std::span(text))); }

EncodedPicture picture_of(std::string_view bytes) {
  const auto span = std::as_bytes(std::span(bytes));
  return make_picture({span.begin(), span.end()}, 4, 2);
}

std::size_t count(const std::string& text, std::string_view part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++found;
  return found;
}

TEST(ReportHtml, WhatMeansSomethingToHtmlIsEscaped) {
  EXPECT_EQ(escape("<script>alert('&')</script>\""), "&lt;script&gt;alert(&#39;&amp;&#39;)&lt;/script&gt;&quot;");
  EXPECT_EQ(escape("Größe 1×2, 影"), "Größe 1×2, 影");
}

TEST(ReportHtml, BytesThatAreNoTextDoNoHarm) {
  EXPECT_EQ(escape("a\xff\xfe"), "a\ufffd\ufffd");
  EXPECT_EQ(escape("\xe5\xbd"), "\ufffd\ufffd");            // cut off
  EXPECT_EQ(escape("\xc0\xbc"), "\ufffd\ufffd");            // an overlong '<'
  EXPECT_EQ(escape("\xed\xa0\x80"), "\ufffd\ufffd\ufffd");  // a surrogate
  EXPECT_EQ(escape(std::string_view("a\0b\x1b[31m", 8)), "a b [31m");
  EXPECT_EQ(escape("\xf0\x9f\x8c\x97"), "\xf0\x9f\x8c\x97");
}

// RFC 4648, section 10.
TEST(ReportHtml, Base64) {
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foob"), "Zm9vYg==");
  EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xfb\xff\xfe"), "+//+");
}

TEST(ReportHtml, NumbersAreWrittenForPeople) {
  EXPECT_EQ(fixed(-1.25, 1), "\u22121.2");
  EXPECT_EQ(fixed(-0.0001, 2), "0.00");
  EXPECT_EQ(fixed(std::numeric_limits<double>::infinity(), 2), "∞");
  EXPECT_EQ(fixed(std::nan(""), 2), "–");
  EXPECT_EQ(significant(0.0125, 2), "0.013");
  EXPECT_EQ(significant(1200, 2), "1200");
  EXPECT_EQ(significant(2.50, 3), "2.5");
  EXPECT_EQ(significant(0, 3), "0");
  EXPECT_EQ(significant(3e-7, 2), "3e-07");
}

// All functions that take untrusted text, with such text in every argument.
TEST(ReportHtml, AHostileNameStaysAName) {
  const std::string evil = "\"'><script>alert(1)</script>";
  const Figure figure{.label = evil, .alt = evil, .picture = picture_of("png")};
  Html body = picture_slider(figure, figure);
  body.add(error_map({.figure = figure,
                      .legend = {.title = evil, .colours = {evil, "#fff"}, .labels = {evil, "{}" + evil}},
                      .codes = picture_of("codes"),
                      .unmeasured = evil}));
  body.add(tiles({{.title = evil, .note = evil, .body = note(evil)}}));
  body.add(code_block(evil)).add(definition_list({{evil, evil}})).add(details(evil, heading(evil)));
  const std::string text = to_text({.title = evil,
                                    .summary = evil,
                                    .facts = {{evil, evil}},
                                    .sections = {{evil, body}, {evil, paragraph(evil)}},
                                    .footer = evil});
  EXPECT_EQ(count(text, "<script>"), 1u);  // the page's own
  EXPECT_EQ(count(text, "alert(1)"), count(text, "&lt;script&gt;alert(1)&lt;/script&gt;"));
  EXPECT_GT(count(text, "alert(1)"), 20u);
  EXPECT_EQ(count(text, "\"'>"), 0u);
}

TEST(ReportHtml, APageHoldsAPictureOnce) {
  const Figure first{.label = "a", .alt = "a", .picture = picture_of("one")};
  const Figure same{.label = "b", .alt = "b", .picture = picture_of("one")};  // another file with the same bytes
  const Figure other{.label = "c", .alt = "c", .picture = picture_of("two")};
  Html body = picture_slider(first, other);
  body.add(picture_slider(same, other)).add(picture(first));
  const std::string text = to_text({.title = "t", .sections = {{"s", body}}});
  EXPECT_EQ(count(text, base64_of("one")), 1u);
  EXPECT_EQ(count(text, base64_of("two")), 1u);
  EXPECT_EQ(count(text, "data-same-as='picture-1'"), 2u);
  EXPECT_EQ(count(text, "data-same-as='picture-2'"), 1u);
  EXPECT_EQ(count(body.str(), base64_of("one")), 3u);  // without a page, each use has its own copy
}

TEST(ReportHtml, APageAsksNothingOfTheNetwork) {
  const Figure figure{.label = "a", .alt = "a", .picture = picture_of("one")};
  const std::string text = to_text({.title = "t", .sections = {{"s", picture(figure)}}});
  EXPECT_EQ(count(text, "default-src &#39;none&#39;"), 1u);
  EXPECT_EQ(count(text, "https://"), 0u);
  EXPECT_EQ(count(text, "<link"), count(text, "href='data:"));
  EXPECT_EQ(count(text, "@import"), 0u);
}

TEST(ReportHtml, ZoomIsOfferedWhereThereArePictures) {
  const Figure figure{.label = "a", .alt = "a", .picture = picture_of("one")};
  EXPECT_EQ(count(to_text({.title = "t", .sections = {{"s", picture(figure)}}}), "data-zoom='4'"), 1u);
  EXPECT_EQ(count(to_text({.title = "t", .sections = {{"s", paragraph("text")}}}), "data-zoom='4'"), 0u);
}

TEST(ReportHtml, ErrorCodesAreSymmetricAndFinestNearZero) {
  EXPECT_EQ(error_code(std::nanf("")), 0);
  EXPECT_EQ(error_code(0), 128);
  EXPECT_EQ(error_code(1), 255);
  EXPECT_EQ(error_code(-1), 1);
  EXPECT_EQ(error_code(3), 255);
  EXPECT_EQ(error_code(-std::numeric_limits<float>::infinity()), 1);
  for (const float error : {0.0001f, 0.003f, 0.05f, 0.4f, 0.97f}) {
    const int code = error_code(error);
    EXPECT_EQ(code - 128, 128 - error_code(-error));
    // As page.js decodes it.
    const auto root = static_cast<float>(code - 128) / 127;
    EXPECT_NEAR(root * root, error, std::sqrt(error) / 127 + 1e-5f);
  }
}

TEST(ReportHtml, OnlyAPageWithErrorMapsOffersTheirRange) {
  const Figure figure{.label = {}, .alt = "map", .picture = picture_of("map")};
  Page page{.title = "t", .sections = {{"s", picture(figure)}}};
  EXPECT_EQ(to_text(page).find("<select"), std::string::npos);
  page.sections.front().body.add(
      error_map({.figure = figure,
                 .legend = {.title = "e", .colours = {"#000000", "#ffffff"}, .labels = {"{}"}},
                 .codes = picture_of("codes"),
                 .unmeasured = "#123456",
                 .range = 0.2}));
  const std::string text = to_text(page);
  EXPECT_EQ(count(text, "<select"), 1u);
  EXPECT_NE(text.find("<span data-label='{}'>0.2</span>"), std::string::npos);
}

}  // namespace
}  // namespace penumbra::report

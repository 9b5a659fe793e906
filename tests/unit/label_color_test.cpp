// Colours that stand for different things can be told apart by people who see colours in other ways.

#include <gtest/gtest.h>

#include <charconv>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include "render/aov_picture.h"
#include "support/color_vision.h"

namespace penumbra::test {
namespace {

void expect_apart(const std::vector<ColorBytes>& colors) {
  for (std::size_t a = 0; a < colors.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) EXPECT_GT(apart(colors[a], colors[b]), 15) << "colours " << a << " and " << b;
  }
}

TEST(LabelColor, AreFarApartForEveryKindOfColourVisionAndFromTheBlackOfTheSky) {
  std::vector<ColorBytes> colors{render::label_color(-1)};
  for (int label = 0; label < render::label_color_count; ++label)
    colors.push_back(render::label_color(static_cast<float>(label)));
  expect_apart(colors);
}

// "--NAME: #1f5fbf;" in a style sheet, each time that it stands there: for light pages and for dark ones.
std::vector<ColorBytes> colors_of(const std::string& css, const std::string& name) {
  std::vector<ColorBytes> found;
  const std::regex entry("--" + name + ": #([0-9a-f]{6})");
  for (std::sregex_iterator at(css.begin(), css.end(), entry); at != std::sregex_iterator(); ++at) {
    const std::string digits = (*at)[1];
    unsigned value = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
    found.push_back({static_cast<std::uint8_t>(value >> 16), static_cast<std::uint8_t>(value >> 8 & 255),
                     static_cast<std::uint8_t>(value & 255)});
  }
  return found;
}

float luminance(const ColorBytes& color) {
  // L* again as the luminance that it is of.
  return std::pow((lab(visions()[0], color).x + 16) / 116, 3.0f);
}

float contrast(const ColorBytes& a, const ColorBytes& b) {
  const float one = luminance(a) + 0.05f, other = luminance(b) + 0.05f;
  return std::max(one, other) / std::min(one, other);
}

TEST(LabelColor, ThoseOfLinesAndBarsInReportsAreToo) {
  std::ifstream file(PENUMBRA_ROOT "/src/report/web/page.css");
  const std::string css{std::istreambuf_iterator<char>(file), {}};
  const std::vector<ColorBytes> cards = colors_of(css, "card");
  ASSERT_EQ(cards.size(), 2u) << "light and dark";
  for (std::size_t theme = 0; theme < cards.size(); ++theme) {
    SCOPED_TRACE(theme == 0 ? "light" : "dark");
    std::vector<ColorBytes> lines;
    for (int line = 0; line < 8; ++line) {
      const std::vector<ColorBytes> both = colors_of(css, "line-" + std::to_string(line));
      ASSERT_EQ(both.size(), cards.size()) << line;
      lines.push_back(both[theme]);
      EXPECT_GE(contrast(both[theme], cards[theme]), 3) << line << ": WCAG 2.2, 1.4.11";
    }
    expect_apart(lines);
    // A verdict that a figure is confirmed. Those that it is not, or in part, have words of these colours.
    EXPECT_FALSE(is_reddish(colors_of(css, "best").at(theme)));
    EXPECT_FALSE(is_reddish(colors_of(css, "best-ink").at(theme)));
    for (const std::size_t word : {4u, 6u}) EXPECT_GE(contrast(lines[word], cards[theme]), 4.5f) << "WCAG 2.2, 1.4.3";
  }
}

}  // namespace
}  // namespace penumbra::test

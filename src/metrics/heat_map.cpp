#include "metrics/heat_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "metrics/heat_color.h"

namespace penumbra::metrics {

namespace {

constexpr int glyph_columns = 3, glyph_rows = 5, dot = 2;  // each dot of a glyph is dot x dot pixels
constexpr int advance = (glyph_columns + 1) * dot, margin = 4;
constexpr std::uint8_t paper = 32, ink = 224;

// Rows of three bits; the highest bit is on the left.
struct Glyph {
  char character;
  std::array<std::uint8_t, glyph_rows> rows;
};
constexpr std::array<Glyph, 11> glyphs{{{'0', {7, 5, 5, 5, 7}},
                                        {'1', {2, 6, 2, 2, 7}},
                                        {'2', {7, 1, 7, 4, 7}},
                                        {'3', {7, 1, 7, 1, 7}},
                                        {'4', {5, 5, 7, 1, 1}},
                                        {'5', {7, 4, 7, 1, 7}},
                                        {'6', {7, 4, 7, 5, 7}},
                                        {'7', {7, 1, 1, 1, 1}},
                                        {'8', {7, 5, 7, 5, 7}},
                                        {'9', {7, 5, 7, 1, 7}},
                                        {'.', {0, 0, 0, 0, 2}}}};

using Rgb = std::array<std::uint8_t, 3>;

class Strip {
 public:
  explicit Strip(int width) : width_(width), pixels_(static_cast<std::size_t>(width) * heat_legend_rows * 3, paper) {}

  void put(int x, int y, const Rgb& color) {
    const std::size_t at = static_cast<std::size_t>(y * width_ + x) * 3;
    std::copy(color.begin(), color.end(), pixels_.begin() + static_cast<std::ptrdiff_t>(at));
  }

  void text(int left, std::string_view characters) {
    for (const char character : characters) {
      const auto* const glyph =
          std::find_if(glyphs.begin(), glyphs.end(), [&](const Glyph& g) { return g.character == character; });
      if (glyph != glyphs.end()) this->glyph(left, *glyph);
      left += advance;
    }
  }

  void bar(int left, int right) {
    for (int x = left; x < right; ++x) {
      const float error = static_cast<float>(x - left) / static_cast<float>(std::max(right - left - 1, 1));
      for (int y = margin; y < heat_legend_rows - margin; ++y) put(x, y, metrics::heat_color(error));
    }
  }

  const std::vector<std::uint8_t>& pixels() const { return pixels_; }

 private:
  void glyph(int left, const Glyph& glyph) {
    constexpr int top = (heat_legend_rows - glyph_rows * dot) / 2;
    for (int y = 0; y < glyph_rows * dot; ++y) {
      for (int x = 0; x < glyph_columns * dot; ++x) {
        const unsigned row = glyph.rows[static_cast<std::size_t>(y / dot)];
        if ((row >> static_cast<unsigned>(glyph_columns - 1 - x / dot) & 1U) != 0)
          put(left + x, top + y, {ink, ink, ink});
      }
    }
  }

  int width_;
  std::vector<std::uint8_t> pixels_;
};

std::vector<std::uint8_t> legend(int width, float scale) {
  Strip strip(width);
  const std::string least = "0", most = fmt::format("{:g}", scale);
  const int left = margin + advance * static_cast<int>(least.size()) + margin;
  const int right = width - margin - advance * static_cast<int>(most.size()) - margin;
  if (right - left < 3 * advance) {
    strip.bar(0, width);
    return strip.pixels();
  }
  strip.text(margin, least);
  strip.bar(left, right);
  strip.text(right + margin, most);
  return strip.pixels();
}

}  // namespace

float heat_scale(float largest) {
  constexpr auto most = static_cast<float>(most_heat_scale);
  for (float decade = 0.001f; decade < most; decade *= 10) {
    for (const float step : {1.0f, 2.0f, 5.0f}) {
      if (largest <= step * decade) return step * decade;
    }
  }
  return most;
}

std::vector<std::uint8_t> heat_map(std::span<const float> errors, int width, int height, float scale) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height + heat_legend_rows) * 3);
  for (const float error : errors) {
    const Rgb color = metrics::heat_color(error / scale);
    rgb.insert(rgb.end(), color.begin(), color.end());
  }
  const std::vector<std::uint8_t> strip = legend(width, scale);
  rgb.insert(rgb.end(), strip.begin(), strip.end());
  return rgb;
}

}  // namespace penumbra::metrics

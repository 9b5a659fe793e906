#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "report/html.h"

namespace penumbra::report {

// Zoom and position belong to the page: all of its pictures show the same part, so that like is compared with like.

// A picture with a text alternative for readers who can't see it.
struct Figure {
  std::string label;  // "pcss": a few words, shown over the picture
  std::string alt;    // a sentence
  EncodedPicture picture;
};

// Two pictures of equal size on top of each other with a divider that the reader drags: `left` is visible to its left.
Html picture_slider(const Figure& left, const Figure& right);

// One picture, which zooms together with the others.
Html picture(const Figure& figure);

// Explains a picture's colours by a labelled colour bar.
struct Legend {
  std::string title;                 // "visibility minus truth"
  std::vector<std::string> colours;  // from low to high at even steps, "#rrggbb"
  std::vector<std::string> labels;   // at even steps under the bar, at least the two ends, with the unit
};

// Errors in colours, whose range the reader can choose for all maps of a page.
struct ErrorMap {
  Figure figure;           // in the colours of the legend, from -range to range
  Legend legend;           // "{}" in a label stands for the range
  EncodedPicture codes;    // grey, 8 bits: error_code() of each pixel
  std::string unmeasured;  // the colour of pixels without an error, "#rrggbb"
  double range = 1;
};
Html error_map(const ErrorMap& map);

// An error from -1 to 1 in 8 bits, finer near 0: 1 to 255, 128 for 0; beyond, as -1 or 1. 0 for not-a-number.
std::uint8_t error_code(float error);

// The ranges that a page offers beside its own.
inline constexpr std::array error_ranges{0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0};

// Side by side where there is room, each under its title and over its note, which may be empty.
struct Tile {
  std::string title, note;
  Html body;
};
Html tiles(const std::vector<Tile>& tiles);

}  // namespace penumbra::report

#pragma once

#include <string>
#include <vector>

#include "report/html.h"

namespace penumbra::report {

// Zoom and place are the page's: all of its pictures show the same part, so that one compares like with like.

// A picture with what it shows in words, for those who can't see it.
struct Figure {
  std::string label;  // "pcss": a few words, shown over the picture
  std::string alt;    // a sentence
  EncodedPicture picture;
};

// Two pictures of one size, one over the other, parted by a handle: `left` shows to its left.
Html picture_slider(const Figure& left, const Figure& right);

// One picture, which zooms with the others.
Html picture(const Figure& figure);

// The meaning of a picture's colours: a bar from `low` to `high`.
struct Legend {
  std::string title;                 // "visibility minus truth"
  std::vector<std::string> colours;  // from low to high at even steps, "#rrggbb"
  std::vector<std::string> labels;   // at even steps under the bar, at least the two ends, with the unit
};
Html legend(const Legend& legend);

// A picture of errors, with what its colours mean under it.
Html error_map(const Figure& figure, const Legend& legend);

// Side by side where there is room, each under its title and over its note, which may be empty.
struct Tile {
  std::string title, note;
  Html body;
};
Html tiles(const std::vector<Tile>& tiles);

}  // namespace penumbra::report

#pragma once

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
Html legend(const Legend& legend);

// A picture of errors with its legend below.
Html error_map(const Figure& figure, const Legend& legend);

// Side by side where there is room, each under its title and over its note, which may be empty.
struct Tile {
  std::string title, note;
  Html body;
};
Html tiles(const std::vector<Tile>& tiles);

}  // namespace penumbra::report

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/html.h"

namespace penumbra::report {

// A part of a page, under a title that its table of contents names.
struct Section {
  std::string title;
  Html body;
};

// One HTML file with all that it needs in it: style, script and pictures. It asks nothing of the network and may not,
// by its own content security policy.
struct Page {
  std::string title;
  std::string summary;                                     // a sentence or two under the title; may be empty
  std::vector<std::pair<std::string, std::string>> facts;  // under the summary: what, where, with what
  std::vector<Section> sections;
  std::string footer;  // what made the page
};

// The file's text. A picture that the page shows several times is in it once.
std::string to_text(const Page& page);

}  // namespace penumbra::report

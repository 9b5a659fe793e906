#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "report/html.h"

namespace penumbra::report {

// A section of a page, whose title the table of contents lists.
struct Section {
  std::string title;
  Html body;
};

// A self-contained HTML file: style, script and pictures are embedded. Its content security policy forbids all network
// access.
struct Page {
  std::string title;
  std::string summary;                                     // a sentence or two under the title; may be empty
  std::vector<std::pair<std::string, std::string>> facts;  // below the summary: what was measured, where and how
  std::vector<Section> sections;
  std::string footer;  // what made the page
};

// Gives the text of the file in parts, so that a large page is not in memory a second time. A picture that the page
// shows several times is stored once.
void write_text(const Page& page, const std::function<void(std::string_view)>& write);

// The whole text.
std::string to_text(const Page& page);

}  // namespace penumbra::report

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/html.h"

namespace penumbra::report {

Html paragraph(std::string_view text);
// Smaller and quieter: what has to be known but is not the point.
Html note(std::string_view text);
Html heading(std::string_view text);  // within a section

// Text to copy, with a button that does it: commands, presets.
Html code_block(std::string_view code);

// Names and their values, as of parameters. Empty: nothing.
Html definition_list(const std::vector<std::pair<std::string, std::string>>& entries);

// `body` behind a title that opens it.
Html details(std::string_view title, const Html& body);

}  // namespace penumbra::report

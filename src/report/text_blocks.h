#pragma once

#include <string>
#include <utility>
#include <vector>

#include "report/html.h"

namespace penumbra::report {

Html paragraph(std::string_view text);
// A note in smaller, lighter text: background that is not the main point.
Html note(std::string_view text);
Html heading(std::string_view text);  // within a section

// Text with a button that copies it: commands, presets.
Html code_block(std::string_view code);

// Names and values, such as parameters. Without entries: nothing.
Html definition_list(const std::vector<std::pair<std::string, std::string>>& entries);

// `body`, hidden until the reader clicks on the title.
Html details(std::string_view title, const Html& body);

}  // namespace penumbra::report

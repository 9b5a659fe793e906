#pragma once

#include <string_view>

namespace penumbra::report {

// The files of src/report/web, which cmake/EmbedWeb.cmake embeds.
std::string_view page_css();
std::string_view page_js();

}  // namespace penumbra::report

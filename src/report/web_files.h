#pragma once

#include <string_view>

namespace penumbra::report {

// src/report/web, embedded by cmake/EmbedWeb.cmake.
std::string_view page_css();
std::string_view page_js();

}  // namespace penumbra::report

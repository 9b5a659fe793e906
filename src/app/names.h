#pragma once

#include <string>
#include <vector>

namespace penumbra::app {

// What the first argument of some commands may be.
const std::vector<std::string>& bake_kinds();
const std::vector<std::string>& planned_commands();  // of plan, besides "show"
std::vector<std::string> listing_names();
std::vector<std::string> explained_names();  // of help

}  // namespace penumbra::app

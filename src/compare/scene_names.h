#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra::compare {

// std::filesystem::path::stem or filename.
using ShortName = std::filesystem::path (std::filesystem::path::*)() const;

// What reports and messages call scenes: their files' short names, with the folder where several have the same, and the
// whole path where several have the same folder too.
std::vector<std::string> scene_names(const std::vector<std::string>& paths, ShortName short_name);

}  // namespace penumbra::compare

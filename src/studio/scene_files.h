#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace penumbra::studio {

// Throws UsageError if the file `result`, which `option` asks for, would take the place of one of a scene's files.
void check_spared(const std::vector<std::filesystem::path>& scene_files, std::string_view option,
                  const std::filesystem::path& result);

}  // namespace penumbra::studio

#pragma once

#include <filesystem>

namespace penumbra::image {

// From now on the module that reads JPEG and EXR is also looked for in this folder: for code that is not in a program
// of Penumbra's, beside which it would be found.
void add_module_folder(const std::filesystem::path& folder);

}  // namespace penumbra::image

#pragma once

#include <filesystem>
#include <system_error>

namespace penumbra::io {

// Where the file of this program lies; empty if `fault` says why that can't be told. Without /proc, as in some change
// roots, the path that the program was started with counts.
std::filesystem::path program_path(std::error_code& fault);

}  // namespace penumbra::io

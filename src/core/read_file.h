#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace penumbra {

// The whole of a regular file of at most `limit` bytes. Throws Error with the cause alone, as the caller knows best
// what the file was to be.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::size_t limit);

}  // namespace penumbra

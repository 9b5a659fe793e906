#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace penumbra {

// The whole of a regular file of at most `limit` bytes. Throws Error with the cause alone ("file not found", "can't be
// read: Permission denied"): the caller adds the file's name and what it was read for.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::size_t limit);

}  // namespace penumbra

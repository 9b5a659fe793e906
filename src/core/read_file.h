#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

namespace penumbra {

// The whole of a regular file of at most `limit` bytes. Throws Error with the cause alone ("file not found", "can't be
// read: Permission denied"): the caller adds the file's name and what it was read for.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::size_t limit);

// A regular file of at most `limit` bytes, of which only the parts that are asked for are read.
class FileParts {
 public:
  // Throws Error like read_file().
  FileParts(const std::filesystem::path& path, std::size_t limit);

  // Reads from `offset` on until `to` is full or the file ends. Returns the number of bytes. Throws Error for a fault.
  std::size_t read(std::size_t offset, std::span<std::byte> to);

 private:
  std::ifstream stream_;
};

}  // namespace penumbra

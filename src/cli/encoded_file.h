#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace penumbra::cli {

// A file that is still to be written.
struct EncodedFile {
  std::filesystem::path path;
  std::vector<std::byte> bytes;
};

}  // namespace penumbra::cli

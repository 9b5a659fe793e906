#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra::viewer {

// What a folder has to open: scenes (.gltf, .glb) and presets (.toml), in letters of either case, and folders to look
// into.
struct FileList {
  struct Entry {
    std::string name;
    bool is_folder = false;
  };

  bool wanted = false;           // to be shown from the next frame on
  std::filesystem::path folder;  // without a slash at its end: its parent is the one above
  std::vector<Entry> entries;    // folders first, each kind by name; hidden ones are left out
  std::string note;              // that it can't be read, or has too much; empty: all is there
};

// Past so many entries a list ends.
constexpr std::size_t most_listed = 5000;

bool is_preset(const std::filesystem::path& file);
FileList list_folder(const std::filesystem::path& folder);
// The folder of a file, "" the present one, up to the first that there is.
std::filesystem::path folder_of(const std::string& file);

}  // namespace penumbra::viewer

#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace penumbra::viewer {

// What can be opened in a folder: scenes (.gltf, .glb), preset files (.toml), whatever the case of the extension, and
// folders.
struct FileList {
  struct Entry {
    std::string name;
    bool is_folder = false;
  };

  bool wanted = false;           // open the list in the next frame
  std::filesystem::path folder;  // without a slash at its end, so that parent_path() is the folder above
  std::vector<Entry> entries;    // folders first, each kind by name; hidden ones are left out
  std::string note;              // why entries are missing; empty if none are
};

// The most entries of a list.
constexpr std::size_t most_listed = 5000;

bool is_preset(const std::filesystem::path& file);
FileList list_folder(const std::filesystem::path& folder);
// The folder of a file, or the nearest existing one above it; "": the working folder.
std::filesystem::path folder_of(const std::string& file);

}  // namespace penumbra::viewer

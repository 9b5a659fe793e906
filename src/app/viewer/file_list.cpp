#include "app/viewer/file_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

namespace penumbra::app {

namespace {

namespace fs = std::filesystem;

bool can_be_opened(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array known{".gltf", ".glb", ".toml"};
  return std::find(known.begin(), known.end(), extension) != known.end();
}

}  // namespace

FileList list_folder(const fs::path& folder) {
  FileList list{.folder = folder.lexically_normal(), .entries = {}, .note = {}};
  std::error_code fault;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end; entry.increment(fault)) {
    const std::string name = entry->path().filename().string();
    std::error_code gone;
    const bool is_folder = entry->is_directory(gone);
    if (gone || name.starts_with('.') || !(is_folder || can_be_opened(entry->path()))) continue;
    if (list.entries.size() == most_listed) {
      list.note = "there is more than can be listed: type the name of the file";
      break;
    }
    list.entries.push_back({name, is_folder});
  }
  if (fault) list.note = "cannot be read: " + fault.message();
  std::sort(list.entries.begin(), list.entries.end(), [](const FileList::Entry& a, const FileList::Entry& b) {
    return a.is_folder != b.is_folder ? a.is_folder : a.name < b.name;
  });
  return list;
}

fs::path folder_of(const std::string& file) {
  std::error_code fault;
  fs::path folder = fs::absolute(file.empty() ? "." : file, fault);
  while (!fs::is_directory(folder, fault) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

}  // namespace penumbra::app

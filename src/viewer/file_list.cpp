#include "viewer/file_list.h"

#include <algorithm>
#include <system_error>

#include "core/names.h"

namespace penumbra::viewer {

namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& file) { return lower_case(file.extension().string()); }

bool can_be_opened(const fs::path& file) {
  const std::string extension = extension_of(file);
  return extension == ".gltf" || extension == ".glb" || is_preset(file);
}

fs::path normal(const fs::path& folder) {
  const fs::path path = folder.lexically_normal();
  return path.has_filename() || !path.has_relative_path() ? path : path.parent_path();
}

}  // namespace

bool is_preset(const fs::path& file) { return extension_of(file) == ".toml"; }

FileList list_folder(const fs::path& folder) {
  FileList list{.folder = normal(folder), .entries = {}, .note = {}};
  std::error_code fault;
  for (fs::directory_iterator entry(folder, fault), end; !fault && entry != end; entry.increment(fault)) {
    const std::string name = entry->path().filename().string();
    std::error_code gone;
    const bool is_folder = entry->is_directory(gone);
    if (gone || name.starts_with('.') || !(is_folder || can_be_opened(entry->path()))) continue;
    if (list.entries.size() == most_listed) {
      list.note = "the folder has more files than can be listed: type the name of the file";
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
  return normal(folder);
}

}  // namespace penumbra::viewer

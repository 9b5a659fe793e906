#include "compare/scene_names.h"

#include <cstddef>
#include <map>

namespace penumbra::compare {

std::vector<std::string> scene_names(const std::vector<std::string>& paths, ShortName short_name) {
  const auto with_folder = [short_name](const std::filesystem::path& path) {
    return (path.parent_path().filename() / (path.*short_name)()).string();
  };
  std::map<std::string, std::size_t> short_names, longer_names;
  for (const std::string& text : paths) {
    const std::filesystem::path path(text);
    ++short_names[(path.*short_name)().string()];
    ++longer_names[with_folder(path)];
  }
  std::vector<std::string> names;
  for (const std::string& text : paths) {
    const std::filesystem::path path(text);
    const std::string name = (path.*short_name)().string(), longer = with_folder(path);
    names.push_back(short_names[name] == 1 ? name : longer_names[longer] == 1 ? longer : text);
  }
  return names;
}

}  // namespace penumbra::compare

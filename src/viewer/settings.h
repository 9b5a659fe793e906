#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/usage.h"
#include "core/params.h"

namespace penumbra::viewer {

// What the viewer keeps from one run to the next.
struct Settings {
  std::vector<std::string> recent;  // scenes, absolute paths, the last one first
  std::optional<cli::Size> window;  // as it was last; absent: never kept
  bool panel = true, vsync = true;
  std::string tab;  // of the side panel, by name; empty: the first
  ParamSet params;  // every parameter of all techniques; those of read_settings() have their defaults at least
};

constexpr std::size_t most_recent = 10;
constexpr std::size_t longest_tab = 32;  // bytes

// $XDG_CONFIG_HOME/penumbra/viewer.json, else $HOME/.config/penumbra/viewer.json. As the XDG base directory
// specification says, a folder that is no absolute path counts for nothing. Empty: there is no such place.
std::filesystem::path settings_file();

// What the last run kept. Without a file the defaults. Also the defaults, and one line about file and cause in `fault`,
// where the file is not all right; keys of other versions are no fault. `fault` is empty otherwise.
Settings read_settings(std::string& fault);

// Throws Error where nothing can be written. What read_settings() would refuse is left out.
void write_settings(const Settings& settings);

// Puts a scene in front of the others, as an absolute path; none is there twice, and the oldest fall off the end.
void add_recent(std::vector<std::string>& recent, const std::string& scene);

}  // namespace penumbra::viewer

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/usage.h"
#include "core/params.h"

namespace penumbra::viewer {

// Pixels. The window shows the panel no narrower than its contents need.
constexpr float usual_panel_width = 390, least_panel_width = 240, most_panel_width = 1600;
constexpr float usual_panel_share = 0.55f, least_panel_share = 0.2f, most_panel_share = 0.8f;
constexpr float least_scale = 0.75f, most_scale = 3;

// What the viewer keeps from one run to the next.
struct Settings {
  std::vector<std::string> recent;  // scenes, absolute paths, the last one first
  std::optional<cli::Size> window;  // its last size; absent if it was never saved
  bool panel = true, vsync = true;
  float panel_width = usual_panel_width;  // at an interface scale of 1
  float panel_share = usual_panel_share;  // of the window's height, where the panel lies below the picture
  float scale = 1;                        // of the interface, beside the desktop's own
  std::string tab;                        // the open one of the side panel; empty: the first
  ParamSet params;  // all parameters; those that the file lacks are as session::usual_technique has them
};

constexpr std::size_t most_recent = 10;
constexpr std::size_t longest_tab = 32;  // bytes

// $XDG_CONFIG_HOME/penumbra/viewer.json, else $HOME/.config/penumbra/viewer.json. As the XDG base directory
// specification says, a relative path is ignored. Empty if neither is set.
std::filesystem::path settings_file();

// Reads the settings of the last run; the defaults if there is no file. If the file is damaged, returns the defaults
// and sets `fault` to one line with its name and the cause, else to nothing. Unknown keys are ignored.
Settings read_settings(std::string& fault);

// Throws Error if the file can't be written. Values that read_settings() would refuse are left out.
void write_settings(const Settings& settings);

// Puts a scene first, as an absolute path, without duplicates; the oldest beyond most_recent are dropped.
void add_recent(std::vector<std::string>& recent, const std::string& scene);

}  // namespace penumbra::viewer

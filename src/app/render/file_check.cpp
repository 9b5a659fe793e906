#include "app/render/file_check.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/render/frame_files.h"
#include "cli/input_files.h"
#include "io/output_file.h"
#include "render/view.h"

namespace penumbra::app {

namespace {

namespace fs = std::filesystem;

fs::path folder_of(const RenderOptions& options, const cli::OutputNames& names) {
  return names.picture(options.frames.value_or(cli::FrameRange{}).first).parent_path();
}

// Whether the picture of a frame has that name, in its folder.
bool is_name_of_picture(const std::string& name, const RenderOptions& options, const cli::OutputNames& names) {
  const std::optional<int> frame = names.frame_of(name);
  const cli::FrameRange range = options.frames.value_or(cli::FrameRange{});
  if (!frame || (options.frames && (*frame < range.first || *frame > range.last))) return false;
  const std::vector<fs::path> files = frame_files(options, names, *frame, render::max_shadowed_lights);
  return std::ranges::find(files, fs::path(name), &fs::path::filename) != files.end();
}

// A picture whose file is a symbolic link is written to the file that the link names.
std::vector<fs::path> linked_places(const RenderOptions& options, const cli::OutputNames& names) {
  std::vector<fs::path> places;
  std::error_code error;
  const fs::path folder = folder_of(options, names);
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code unknown;
    if (entry->is_symlink(unknown) && is_name_of_picture(entry->path().filename().string(), options, names))
      places.push_back(io::place_of(entry->path()));
  }
  return places;
}

// Whether a file written to `result` would overwrite the picture of a frame.
bool is_picture(const fs::path& result, const RenderOptions& options, const cli::OutputNames& names,
                const std::vector<fs::path>& linked) {
  const fs::path place = io::place_of(result);
  if (std::ranges::find(linked, place) != linked.end()) return true;
  return place.parent_path() == io::place_of(folder_of(options, names) / "picture").parent_path() &&
         is_name_of_picture(place.filename().string(), options, names);
}

void check_alone(const char* option, const fs::path& result, const RenderOptions& options,
                 const cli::OutputNames& names) {
  if (is_picture(result, options, names, linked_places(options, names)))
    cli::fail_usage("{} {} is a picture of this command too", option, io::quoted(result));
  io::check_writable(result);
}

}  // namespace

void check_scene_files(const std::vector<fs::path>& files, const RenderOptions& options,
                       const cli::OutputNames& names) {
  cli::InputFiles inputs;
  inputs.add_scene(files);
  inputs.add_shaders(options);
  // A preset may be read and saved under one name: that changes it.
  if (!options.save_preset.empty()) inputs.check("--save-preset", options.save_preset);
  inputs.add_presets(options.presets);
  if (!options.stats.empty()) inputs.check("--stats", options.stats);
  const std::vector<fs::path> linked = linked_places(options, names);
  for (const cli::InputFile& file : inputs.files()) {
    if (is_picture(file.path, options, names, linked)) cli::fail_overwrite("-o", file.what, file.path);
  }
}

void check_files(const RenderOptions& options, const cli::OutputNames& names) {
  check_scene_files({options.scene}, options, names);
  const int first = options.frames.value_or(cli::FrameRange{}).first;
  for (const fs::path& file : frame_files(options, names, first, /* lights= */ 1)) io::check_writable(file);
  if (!options.save_preset.empty()) check_alone("--save-preset", options.save_preset, options, names);
  if (options.stats.empty()) return;
  check_alone("--stats", options.stats, options, names);
  if (!options.save_preset.empty() && io::place_of(options.stats) == io::place_of(options.save_preset))
    cli::fail_usage("--stats and --save-preset name the same file {}", io::quoted(options.stats));
}

}  // namespace penumbra::app

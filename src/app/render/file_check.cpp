#include "app/render/file_check.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "app/render/frame_files.h"
#include "cli/input_files.h"
#include "io/output_file.h"
#include "render/view.h"

namespace penumbra::app {

namespace {

namespace fs = std::filesystem;

// A picture whose file is a symbolic link is written to the file that the link names.
std::vector<fs::path> linked_places(const RenderOptions& options, const cli::OutputNames& names) {
  std::vector<fs::path> places;
  const auto add = [&](const fs::path& picture) {
    std::error_code error;
    if (fs::is_symlink(fs::symlink_status(picture, error))) places.push_back(io::place_of(picture));
  };
  const cli::FrameRange range = options.frames.value_or(cli::FrameRange{});
  for (int frame = range.first; frame <= range.last; ++frame) {
    for (const fs::path& file : frame_files(options, names, frame, render::max_shadowed_lights)) add(file);
  }
  return places;
}

// Whether a file written to `result` would overwrite the picture of a frame.
bool is_picture(const fs::path& result, const RenderOptions& options, const cli::OutputNames& names,
                const std::vector<fs::path>& linked) {
  const fs::path place = io::place_of(result), name = place.filename();
  if (std::ranges::find(linked, place) != linked.end()) return true;
  const cli::FrameRange range = options.frames.value_or(cli::FrameRange{});
  const fs::path folder = names.picture(range.first).parent_path();
  if (place.parent_path() != io::place_of(folder / "picture").parent_path()) return false;
  for (int frame = range.first; frame <= range.last; ++frame) {
    const std::vector<fs::path> files = frame_files(options, names, frame, render::max_shadowed_lights);
    if (std::ranges::find(files, name, &fs::path::filename) != files.end()) return true;
  }
  return false;
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

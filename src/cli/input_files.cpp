#include "cli/input_files.h"

#include <algorithm>
#include <array>
#include <system_error>

#include "cli/usage.h"
#include "core/names.h"
#include "io/output_file.h"

namespace penumbra::cli {

namespace fs = std::filesystem;

void fail_overwrite(std::string_view option, std::string_view what, const fs::path& path) {
  fail_usage("{} would overwrite {} {}", option, what, io::quoted(path));
}

void InputFiles::add(std::string_view what, const fs::path& path) {
  files_.push_back({std::string(what), path, io::place_of(path)});
}

void InputFiles::add_scene(std::span<const fs::path> files) {
  for (const fs::path& file : files) add("the scene's file", file);
}

void InputFiles::add_presets(std::span<const std::string> files) {
  for (const std::string& file : files) add("the preset", file);
}

void InputFiles::add_shaders(const DeviceOptions& options) {
  std::error_code missing;
  if (!options.glsl.empty()) shaders_ = fs::canonical(options.glsl, missing);
}

void InputFiles::check(std::string_view option, const fs::path& output) const {
  const fs::path place = io::place_of(output);
  for (const InputFile& file : files_) {
    if (place == file.place) fail_overwrite(option, file.what, file.path);
  }
  if (is_shader(place)) fail_overwrite(option, "a file of --glsl:", output);
}

bool InputFiles::is_shader(const fs::path& place) const {
  if (shaders_.empty()) return false;
  constexpr std::array outputs{".png", ".exr", ".json", ".toml", ".csv", ".html"};
  const fs::path within = place.lexically_relative(shaders_);
  std::error_code error;
  return !within.empty() && *within.begin() != ".." && fs::is_regular_file(place, error) &&
         std::ranges::find(outputs, lower_case(place.extension().string())) == outputs.end();
}

}  // namespace penumbra::cli

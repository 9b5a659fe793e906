#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/options.h"

namespace penumbra::cli {

// A file that a command reads.
struct InputFile {
  std::string what;  // for messages: "the scene's file"
  std::filesystem::path path;
  std::filesystem::path place;  // io::place_of(path)
};

// The files that a command reads, none of which its outputs may overwrite.
class InputFiles {
 public:
  void add(std::string_view what, const std::filesystem::path& path);
  void add_scene(std::span<const std::filesystem::path> files);
  void add_presets(std::span<const std::string> files);
  // The files in the folder of --glsl, at any depth, except those of the kinds that Penumbra writes (pictures, JSON,
  // TOML, CSV, HTML), which can't be shaders.
  void add_shaders(const DeviceOptions& options);

  // Without the files of --glsl, which have no list.
  const std::vector<InputFile>& files() const { return files_; }

  // Throws UsageError if a file written to `output`, which `option` asks for, would overwrite one of them.
  void check(std::string_view option, const std::filesystem::path& output) const;

 private:
  bool is_shader(const std::filesystem::path& place) const;

  std::vector<InputFile> files_;
  std::filesystem::path shaders_;  // canonical; empty: none
};

// Throws the UsageError of InputFiles::check().
[[noreturn]] void fail_overwrite(std::string_view option, std::string_view what, const std::filesystem::path& path);

}  // namespace penumbra::cli

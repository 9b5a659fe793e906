#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/cli_fwd.h"
#include "scene/gltf.h"

namespace penumbra::cli {

// How scene files are read.
struct ReadingOptions {
  std::vector<std::string> limits;                                  // "images=4GiB"; each is valid
  std::vector<std::pair<std::string, scene::CastSetting>> casters;  // by material
  bool follow_links = false;
  bool skies_chosen = false;  // casters.skies is set, so no warning says that skies cast none; set by the program
  scene::ReadOptions::NamesFiles names_files = {};  // set by the program, not by an option
  bool progress = false;                            // show it on the terminal; set by the program, not by an option
};

void add_reading_options(CLI::App& app, ReadingOptions& options);

// The limits on what a scene may take. By default decoded images may take two fifths of the free memory, because
// drawing needs as much again and a third more for mip levels, and all other data half of it. --limit overrides these.
scene::ReadLimits limits_of(const ReadingOptions& options);

// Reads a scene. Throws Error, also if --casters names a material that the scene lacks.
scene::Scene read_scene(const std::string& file, const ReadingOptions& options, const scene::ImageDecoder& decode);

// The options as arguments of a command line.
std::vector<std::string> reading_arguments(const ReadingOptions& options);

}  // namespace penumbra::cli

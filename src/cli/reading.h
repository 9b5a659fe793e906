#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/cli_fwd.h"
#include "scene/gltf.h"

namespace penumbra::cli {

// How scene files are read.
struct ReadingOptions {
  std::vector<std::string> limits;                              // "images=4GiB", each right by itself
  std::vector<std::pair<std::string, scene::Casting>> casters;  // by material
  bool follow_links = false;
  bool progress = false;  // on the terminal; no option of the command line
};

void add_reading_options(CLI::App& app, ReadingOptions& options);

// The limits: of the memory that the machine has left, two fifths for decoded images, since drawing needs as much again
// and a third for mip levels, and half for all other data; over these, what --limit says.
scene::ReadLimits limits_of(const ReadingOptions& options);

// Reads a scene. Throws Error, also for a material of --casters that it lacks.
scene::Scene read_scene(const std::string& file, const ReadingOptions& options, const scene::ImageDecoder& decode);

// The options as arguments of a command line.
std::vector<std::string> reading_arguments(const ReadingOptions& options);

}  // namespace penumbra::cli

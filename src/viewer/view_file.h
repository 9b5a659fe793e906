#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "viewer/bookmarks.h"

namespace penumbra::viewer {

// What is saved beside a scene for the next time that it is opened: camera, sun, lights and lamps, and the bookmarks.
struct SavedView {
  cli::SceneOptions options;  // of which only those of view_arguments() count
  Bookmarks bookmarks;
};

// SCENE.view.json
std::filesystem::path view_file(const std::string& scene);

// What was saved beside the scene; nothing if there is no file. If the file is damaged, returns nothing and sets
// `fault` to one line with its name and the cause, else to nothing. Unknown keys are ignored.
std::optional<SavedView> read_view(const std::string& scene, std::string& fault);

// Throws Error if the file can't be written.
void write_view(const std::string& scene, const SavedView& view);

// Takes a saved camera, sun, lights and lamps, each unless the options have their own.
void use_view(const cli::SceneOptions& saved, cli::SceneOptions& options);

}  // namespace penumbra::viewer

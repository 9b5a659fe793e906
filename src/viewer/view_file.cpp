#include "viewer/view_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "io/output_file.h"
#include "viewer/document.h"
#include "viewer/json_file.h"

namespace penumbra::viewer {

namespace {

using io::Json;

constexpr std::array<std::string_view, 3> bookmark_options{"--eye=", "--target=", "--fov="};
constexpr std::array<std::string_view, 9> view_options{
    "--camera=", "--eye=", "--target=", "--fov=", "--sun=", "--no-sun", "--lights=", "--lamp-radius=", "--lamp="};

// Options of a view as `penumbra render` takes them. Others, such as --help, are none of a file's.
cli::SceneOptions parse_options(const std::vector<std::string>& arguments, std::span<const std::string_view> known) {
  for (const std::string& argument : arguments) {
    const auto begins = [&](std::string_view option) { return argument.starts_with(option); };
    if (std::ranges::none_of(known, begins)) fail("'{}' is no option of a view", argument);
  }
  cli::SceneOptions options;
  CLI::App app;
  cli::add_view_options(app, options);
  try {
    app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));  // CLI11 takes them last first
  } catch (const CLI::ParseError& error) {
    fail("{}", error.what());
  }
  cli::check_together(options);
  return options;
}

cli::SceneOptions options_of(const Json& list, std::string_view name, std::span<const std::string_view> known) {
  const auto is_text = [](const Json& entry) { return entry.is_string(); };
  if (!list.is_array() || !std::ranges::all_of(list, is_text)) fail("'{}' takes a list of options", name);
  return parse_options(list.get<std::vector<std::string>>(), known);
}

void take_bookmark(const std::string& key, const Json& list, Bookmarks& bookmarks) {
  const std::size_t index = key.size() == 1 ? static_cast<std::size_t>(key[0] - '1') : bookmarks.size();
  if (index >= bookmarks.size()) fail("'bookmarks' has the names 1 to 9, not '{}'", key);
  try {
    bookmarks.at(index) = bookmark_from(options_of(list, "bookmarks." + key, bookmark_options));
    if (!bookmarks.at(index)) fail("--eye, --target and --fov are needed");
  } catch (const Error& error) {
    fail("bookmark {}: {}", key, error.what());
  }
}

void take_bookmarks(const Json& file, Bookmarks& bookmarks) {
  const Json* json = find(file, "bookmarks");
  if (json == nullptr) return;
  if (!json->is_object()) fail("'bookmarks' takes cameras by number, not {}", json->type_name());
  for (const auto& [key, list] : json->items()) take_bookmark(key, list, bookmarks);
}

SavedView view_of(const Json& file) {
  if (!file.is_object()) fail("not a view, but {}", file.type_name());
  SavedView view;
  if (const Json* list = find(file, "view")) view.options = options_of(*list, "view", view_options);
  take_bookmarks(file, view.bookmarks);
  return view;
}

}  // namespace

std::filesystem::path view_file(const std::string& scene) { return scene + ".view.json"; }

std::optional<SavedView> read_view(const std::string& scene, std::string& fault) {
  fault.clear();
  const std::filesystem::path file = view_file(scene);
  std::error_code code;
  if (!std::filesystem::exists(file, code) && !code) return {};
  try {
    if (code) fail("{}", code.message());
    return view_of(read_json(file));
  } catch (const Error& error) {
    fault = ignored("view", file, error.what());
    return {};
  }
}

void write_view(const std::string& scene, const SavedView& view) {
  Json bookmarks = Json::object();
  for (std::size_t i = 0; i < view.bookmarks.size(); ++i) {
    if (view.bookmarks[i]) bookmarks[std::to_string(i + 1)] = arguments_of(*view.bookmarks[i]);
  }
  const Json file{{"view", view_arguments(view.options)}, {"bookmarks", bookmarks}};
  // A camera may fly farther than the options go. What can't be read again would take the rest with it.
  try {
    view_of(file);
  } catch (const Error& error) {
    fail("cannot write {}: {}", io::quoted(view_file(scene)), error.what());
  }
  io::write_text(view_file(scene), io::text_of(file));
}

void use_view(const cli::SceneOptions& saved, cli::SceneOptions& options) {
  if (!options.camera && !options.eye && !options.fov) {
    options.camera = saved.camera;
    options.eye = saved.eye;
    options.target = saved.target;
    options.fov = saved.fov;
  }
  if (!options.sun && !options.no_sun) {
    options.sun = saved.sun;
    options.no_sun = saved.no_sun;
  }
  if (!options.lights && !options.lamp_radius && options.lamps.empty()) {
    options.lights = saved.lights;
    options.lamp_radius = saved.lamp_radius;
    options.lamps = saved.lamps;
  }
}

}  // namespace penumbra::viewer

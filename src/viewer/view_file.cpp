#include "viewer/view_file.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "io/output_file.h"
#include "viewer/document.h"
#include "viewer/json_file.h"

namespace penumbra::viewer {

namespace {

using io::Json;

constexpr std::array<std::string_view, 9> view_options{
    "--camera=", "--eye=", "--target=", "--fov=", "--sun=", "--no-sun", "--lights=", "--lamp-radius=", "--lamp="};

// Options of a view as `penumbra render` takes them. Others, such as --help, are none of a file's.
cli::SceneOptions parse_options(const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    const auto begins = [&](std::string_view option) { return argument.starts_with(option); };
    if (std::ranges::none_of(view_options, begins)) fail("'{}' is no option of a view", argument);
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

cli::SceneOptions options_of(const Json& list, const char* name) {
  const auto is_text = [](const Json& entry) { return entry.is_string(); };
  if (!list.is_array() || !std::ranges::all_of(list, is_text)) fail("'{}' takes a list of options", name);
  return parse_options(list.get<std::vector<std::string>>());
}

SavedView view_of(const Json& file) {
  if (!file.is_object()) fail("not a view, but {}", file.type_name());
  SavedView view;
  if (const Json* list = find(file, "view")) view.options = options_of(*list, "view");
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
  io::write_text(view_file(scene), io::text_of({{"view", view_arguments(view.options)}}));
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

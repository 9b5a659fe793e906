#include "viewer/options.h"

#include <CLI/CLI.hpp>

#include "cli/input_files.h"
#include "cli/output_names.h"

namespace penumbra::viewer {

void add_view_command_options(CLI::App& app, ViewOptions& options) {
  app.add_option("SCENE", options.scene,
                 "glTF file, .gltf or .glb (the last one that was shown, or else one that comes with Penumbra)")
      ->type_name("");
  cli::add_value(app, "--size", "WIDTHxHEIGHT", "Size of the window, pixels (its last size, or else 1280x720)",
                 [&options](const auto& text) {
                   options.size = cli::parse_size("--size", text);
                   options.sized = true;
                 });
  cli::add_samples_option(app, options,
                          "Samples of each pixel of a picture at rest, for smooth edges; 1: jagged edges (4)");
  app.add_flag("--defaults", options.defaults, "Ignore the settings of the last run, and save none")
      ->disable_flag_override();
  cli::add_view_options(app, options);
  cli::add_time_options(app, options);
  cli::add_technique_option(app, options);
  cli::add_shadow_options(app, options);
  session::add_cache_options(app, options);
  cli::add_device_options(app, options);
  cli::add_value(
      app, "--layout", "FILE",
      "Write the rectangles of all widgets as JSON, for scripts that drive the window; -: to standard output",
      [&options](const auto& text) { options.layout = cli::text_output(text); });
  // Options of `render` that a window refuses: not in --help, but with a specific message.
  for (const char* name : {"--frames", "--backend", "--egl-device"}) app.get_option(name)->group("");
}

void check_together(const ViewOptions& options) {
  cli::check_together(static_cast<const cli::SceneOptions&>(options));
  cli::check_together(static_cast<const cli::DeviceOptions&>(options));
  if (options.frames) cli::fail_usage("--frames is not for a window, which can play all frames");
  if (options.egl_device) cli::fail_usage("--egl-device is not for a window, which uses the desktop's driver");
  if (options.backend != "auto" && options.backend != "window")
    cli::fail_usage("--backend {} can't open a window", options.backend);
  if (options.layout.empty()) return;
  cli::InputFiles inputs;
  if (!options.scene.empty()) inputs.add("the scene's file", options.scene);
  inputs.add_presets(options.presets);
  inputs.add_shaders(options);
  inputs.check("--layout", options.layout);
}

}  // namespace penumbra::viewer

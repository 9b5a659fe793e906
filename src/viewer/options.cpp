#include "viewer/options.h"

#include <CLI/CLI.hpp>

namespace penumbra::viewer {

void add_view_command_options(CLI::App& app, ViewOptions& options) {
  app.add_option("SCENE", options.scene,
                 "glTF file, .gltf or .glb; else the last one that was shown, else one that comes with Penumbra")
      ->type_name("");
  cli::add_value(app, "--size", "WIDTHxHEIGHT", "The window, pixels (as it was last; 1280x720)",
                 [&options](const auto& text) {
                   options.size = cli::parse_size("--size", text);
                   options.sized = true;
                 });
  app.add_flag("--defaults", options.defaults, "Begins anew, whatever the last run kept, and keeps nothing")
      ->disable_flag_override();
  cli::add_view_options(app, options);
  cli::add_time_options(app, options);
  cli::add_technique_option(app, options);
  cli::add_shadow_options(app, options);
  session::add_cache_options(app, options);
  cli::add_device_options(app, options);
  cli::add_value(app, "--layout", "FILE", "Writes where each widget stands as JSON, for scripts that drive the window",
                 [&options](const auto& text) { options.layout = text; });
  // A window has one device, and plays all frames: what is said to those that know them from `render`, not in --help.
  for (const char* name : {"--frames", "--backend", "--egl-device"}) app.get_option(name)->group("");
}

void check_together(const ViewOptions& options) {
  cli::check_together(static_cast<const cli::SceneOptions&>(options));
  cli::check_together(static_cast<const cli::DeviceOptions&>(options));
  if (options.frames) cli::fail_usage("--frames has no meaning for a window, which plays all of them");
  if (options.egl_device) cli::fail_usage("--egl-device has no window: the desktop's driver draws");
  if (options.backend != "auto" && options.backend != "window")
    cli::fail_usage("--backend {} has no window", options.backend);
}

}  // namespace penumbra::viewer

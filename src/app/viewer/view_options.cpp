#include "app/viewer/view_options.h"

#include <CLI/CLI.hpp>

namespace penumbra::app {

void add_view_command_options(CLI::App& app, ViewOptions& options) {
  app.add_option("SCENE", options.scene,
                 "glTF file, .gltf or .glb; else the last one that was shown, else one that comes with Penumbra")
      ->type_name("");
  studio::add_value(app, "--size", "WIDTHxHEIGHT", "The window, pixels (as it was last; 1280x720)",
                    [&options](const auto& text) {
                      options.size = studio::parse_size("--size", text);
                      options.sized = true;
                    });
  app.add_flag("--defaults", options.defaults, "Begins anew, whatever the last run kept, and keeps nothing")
      ->disable_flag_override();
  studio::add_view_options(app, options);
  studio::add_time_options(app, options);
  studio::add_technique_option(app, options);
  studio::add_shadow_options(app, options);
  add_cache_options(app, options);
  studio::add_device_options(app, options);
  studio::add_value(app, "--layout", "FILE",
                    "Writes where each widget stands as JSON, for scripts that drive the window",
                    [&options](const auto& text) { options.layout = text; });
  // A window has one device, and plays all frames: what is said to those that know them from `render`, not in --help.
  for (const char* name : {"--frames", "--backend", "--egl-device"}) app.get_option(name)->group("");
}

void check_together(const ViewOptions& options) {
  studio::check_together(static_cast<const studio::StageOptions&>(options));
  studio::check_together(static_cast<const studio::DeviceOptions&>(options));
  if (options.frames) studio::fail_usage("--frames has no meaning for a window, which plays all of them");
  if (options.egl_device) studio::fail_usage("--egl-device has no window: the desktop's driver draws");
  if (options.backend != "auto" && options.backend != "window")
    studio::fail_usage("--backend {} has no window", options.backend);
}

}  // namespace penumbra::app

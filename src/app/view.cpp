#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>

#include "app/commands.h"
#include "app/viewer/view_options.h"
#include "app/viewer/viewer.h"
#include "io/output_file.h"
#include "studio/studio.h"

namespace penumbra::app {

int run_view(const Arguments& arguments) {
  CLI::App app("Show a glTF scene in a window and tune its shadows", "penumbra view");
  ViewOptions options;
  add_view_command_options(app, options);
  if (!studio::parse(app, arguments)) return 0;
  check_together(options);
  if (const std::string missing = missing_display(); !missing.empty())
    fail("no window can be opened: {}; penumbra render draws into a file, penumbra watch does so at every change",
         missing);
  std::error_code fault;
  if (!options.scene.empty() && !std::filesystem::exists(options.scene, fault))
    fail("cannot read {}: {}", io::quoted(options.scene), fault ? fault.message() : "no such file");
  studio::limit_threads(options);
  return Viewer(options).run();
}

}  // namespace penumbra::app

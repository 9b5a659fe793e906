#include <CLI/CLI.hpp>
#include <filesystem>
#include <system_error>

#include "io/output_file.h"
#include "session/render_session.h"
#include "viewer/command.h"
#include "viewer/options.h"
#include "viewer/viewer.h"

namespace penumbra::viewer {

int run(const cli::Arguments& arguments) {
  CLI::App app("Show a glTF scene in a window and tune its shadows", "penumbra view");
  ViewOptions options;
  add_view_command_options(app, options);
  if (!cli::parse(app, arguments)) return 0;
  check_together(options);
  if (const std::string missing = missing_display(); !missing.empty())
    fail("no window can be opened: {}; penumbra render draws into a file, penumbra watch does so at every change",
         missing);
  std::error_code fault;
  if (!options.scene.empty() && !std::filesystem::exists(options.scene, fault))
    fail("cannot read {}: {}", io::quoted(options.scene), fault ? fault.message() : "no such file");
  session::limit_threads(options);
  return Viewer(options).run();
}

}  // namespace penumbra::viewer

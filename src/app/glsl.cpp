#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "cli/output_names.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "cli/usage.h"
#include "core/error.h"
#include "gl/shader_source.h"
#include "io/output_file.h"

namespace penumbra::app {

namespace {

namespace fs = std::filesystem;

void refuse_present(const fs::path& folder, const std::vector<std::string>& names) {
  std::error_code error;
  for (const std::string& name : names) {
    if (fs::exists(fs::symlink_status(folder / name, error)))
      fail("{} exists already: --force overwrites it", io::quoted(folder / name));
  }
}

}  // namespace

int run_glsl(const Arguments& arguments) {
  CLI::App app("Write the built-in shaders to a folder, for editing; --glsl DIR draws with them", "penumbra glsl");
  std::string output;
  bool force = false, quiet = false;
  app.add_option("DIR", output, "Folder to write to; made if it is missing")->required()->type_name("");
  app.add_flag("--force", force, "Overwrites files of these names")->disable_flag_override();
  app.add_flag("--quiet,-q", quiet, "No summary")->disable_flag_override();
  if (!cli::parse(app, arguments)) return 0;
  output = cli::output_folder("DIR", output);
  if (output.empty()) cli::fail_usage("DIR is a folder's name, not an empty text");

  cli::clean_up_on_signals();
  const fs::path folder(output);
  const gl::ShaderFiles built_in;
  const std::vector<std::string> names = gl::ShaderFiles::built_in_names();
  if (!force) refuse_present(folder, names);
  std::vector<std::pair<std::string, std::string>> files;
  for (const std::string& name : names) files.emplace_back(name, built_in.read(name).value());
  io::write_files(folder, files);
  if (!quiet) fmt::print("wrote {} shader files to {}\n", names.size(), cli::printable(output));
  return 0;
}

}  // namespace penumbra::app

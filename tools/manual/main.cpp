// penumbra-manual FOLDER: writes the manual page penumbra.1, and the completion scripts penumbra.bash and _penumbra
// (for zsh), from the options of the program's commands.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "cli/command_line.h"
#include "cli/usage.h"
#include "io/output_file.h"
#include "manual/command_lines.h"
#include "manual/completion.h"
#include "manual/man_page.h"

int main(int argc, char** argv) {
  using namespace penumbra;
  return cli::run_guarded([&] {
    if (argc != 2) cli::fail_usage("usage: penumbra-manual FOLDER");
    const std::filesystem::path folder = argv[1];
    const std::vector<manual::CommandLine> commands = manual::command_lines();
    io::write_text(folder / "penumbra.1", manual::man_page(commands));
    io::write_text(folder / "penumbra.bash", manual::bash_completion(commands));
    io::write_text(folder / "_penumbra", manual::zsh_completion(commands));
    return 0;
  });
}

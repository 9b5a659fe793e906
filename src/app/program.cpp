#include <array>
#include <string>

#include "app/commands.h"
#include "bench/bench.h"
#include "compare/command.h"
#include "image/read.h"
#include "reproduce/command.h"
#include "truth/technique.h"
#ifdef PENUMBRA_VIEWER
#include "viewer/command.h"
#endif
#include "cli/text.h"
#include "cli/usage.h"

namespace penumbra::app {

namespace {

int run_bench(const Arguments& arguments) {
  return bench::run("penumbra bench", arguments, image::image_decoder,
                    [](int threads) { return truth::TruthTechnique({.threads = threads}).registry(); });
}

constexpr std::array table{
    Command{"render", "Draw a glTF scene into a PNG or EXR file", run_render},
    Command{"watch", "Draw a picture again whenever its scene, a preset file or a shader is saved", run_watch},
    Command{"glsl", "Write the built-in shaders to a folder, for editing", run_glsl},
#ifdef PENUMBRA_VIEWER
    Command{"view", "Show a scene in a window and tune its shadows", viewer::run},
#endif
    Command{"truth", "Ray trace the shadows of a scene, as a reference for techniques", run_truth},
    Command{"info", "Print what is in a scene", run_info},
    Command{"list", "List techniques, filters, denoisers, products, params, aovs or backends", run_list},
    Command{"diff", "Compare two pictures, and fail if they differ by more than a limit", run_diff},
    Command{"compare", "Compare techniques with the truth: tables and an HTML page", compare::run},
    Command{"bench", "Measure what shadows cost, pass by pass", run_bench},
    Command{"plan", "Divide a compare, render, truth or bench into items that machines can share", run_plan},
    Command{"work", "Draw items of a plan into a shared folder", run_work},
    Command{"merge", "Write the report of a plan whose items are drawn", run_merge},
    Command{"reproduce", "Draw and measure the figures of the thesis again: an HTML page", reproduce::run},
    Command{"bake", "Make noise tiles, keys and sets of sample points", run_bake},
    Command{"help", "Explain a parameter, technique, filter, denoiser, product, AOV or command", run_help},
    Command{"doctor", "Print which OpenGL backends work here", run_doctor},
};

std::string overview() {
  std::string text = "Penumbra renders soft shadows.\n\nusage: penumbra COMMAND [OPTIONS]\n\n";
  for (const Command& command : table) text += fmt::format("  {:<9} {}\n", command.name, command.summary);
  text +=
      "\npenumbra COMMAND --help lists a command's options. penumbra list lists techniques, parameters and other "
      "names, "
      "and penumbra help NAME explains one, or a group of parameters such as filter.\n"
      "penumbra --version prints the version.\n\n"
      "Exit codes: 0: done. 2: usage error. 1: any other failure, such as a file that can't be read, a camera that the "
      "scene lacks, a machine without OpenGL, or a limit of diff that is exceeded.\n";
  return cli::wrapped(text);
}

const Command& find_command(const std::string& name) {
  std::vector<std::string> names;
  for (const Command& command : table) {
    if (name == command.name) return command;
    names.emplace_back(command.name);
  }
  if (name.starts_with('-')) cli::fail_usage("'{}' comes before a command; see penumbra --help", name);
  cli::fail_unknown_usage("command", name, names);
}

int dispatch(const Arguments& arguments) {
  if (arguments.empty()) cli::fail_usage("no command given; see penumbra --help");
  const std::string& first = arguments.front();
  if (first == "--version") {
    fmt::print("{}\n", cli::version());
    return 0;
  }
  if (first == "--help" || first == "-h" || (first == "help" && arguments.size() == 1)) {
    fmt::print("{}", overview());
    return 0;
  }
  return find_command(first).run(Arguments(arguments.begin() + 1, arguments.end()));
}

}  // namespace

std::span<const Command> commands() { return table; }

int run_program(const Arguments& arguments) {
  return cli::run_guarded([&] { return dispatch(arguments); });
}

}  // namespace penumbra::app

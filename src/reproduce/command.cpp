#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>

#include "cli/output_names.h"
#include "cli/progress.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "io/output_file.h"
#include "io/program_path.h"
#include "reproduce/command.h"
#include "reproduce/figures.h"
#include "reproduce/report.h"

namespace penumbra::reproduce {

namespace {

struct Entry {
  MakeFigure make;
  int pictures;  // about how long it takes, in pictures of few taps; for the estimate of the time left
};

// In the order of the page.
constexpr std::array figures{
    Entry{section_2_2, 12}, Entry{section_2_3, 3},  Entry{section_2_5, 82}, Entry{figure_2_8, 1},
    Entry{figure_2_9, 2},   Entry{figure_2_10, 1},  Entry{figure_2_11, 0},  Entry{figure_2_12, 0},
    Entry{figure_2_13, 0},  Entry{figure_2_14, 2},  Entry{figure_4_1, 3},   Entry{figure_4_2, 6},
    Entry{figure_4_3, 4},   Entry{figure_4_4, 4},   Entry{figure_4_5, 4},   Entry{figure_4_6, 2},
    Entry{figure_4_7, 12},  Entry{figure_4_8, 3},   Entry{figure_4_9, 5},   Entry{figure_4_10, 3},
    Entry{figure_4_11, 1},  Entry{figure_4_12, 40}, Entry{figure_4_13, 0},  // which shows its own progress
};
constexpr int references = 8;  // cost of truth and converged PCSS, in the same unit

// A scene that comes with the program, in the source tree or the installation.
std::string shipped_scene(const char* name) {
  namespace fs = std::filesystem;
  const fs::path file = fs::path("scenes") / name;
  std::error_code error;
  if (fs::exists(file, error)) return file.string();
  for (fs::path folder = io::program_path(error).parent_path(); folder.has_relative_path();
       folder = folder.parent_path()) {
    for (const fs::path& path : {folder / file, folder / "share" / "penumbra" / file}) {
      if (fs::exists(path, error)) return path.string();
    }
  }
  fail("there is no {} here or beside the program", io::quoted(file));
}

void add_reproduce_options(CLI::App& app, Options& o, std::optional<cli::Size>& size) {
  app.add_option("SCENE", o.scene, "glTF file, .gltf or .glb (scenes/thesis.glb, which comes with Penumbra)")
      ->type_name("");
  cli::add_value(app, "-o,--output", "FOLDER", "Folder for index.html, figures.json and figures.csv",
                 [&o](const auto& text) { o.output = cli::output_folder("-o", text); });
  app.get_option("--output")->required();
  app.add_flag("--quick", o.quick, "Small pictures and few frames: a preview, not a measurement")
      ->disable_flag_override();
  cli::add_value(app, "--size", "WIDTHxHEIGHT", "Pixels (640x360; with --quick 192x108)",
                 [&size](const auto& text) { size = cli::parse_size("--size", text); });
  cli::add_view_options(app, o);
  cli::add_device_options(app, o);
  session::add_cache_options(app, o);
  app.add_flag("--quiet,-q", o.quiet, "No progress and no verdicts")->disable_flag_override();
}

bool parse(const cli::Arguments& arguments, Options& options) {
  CLI::App app("Draw and measure the figures of the thesis again: an HTML page", "penumbra reproduce");
  std::optional<cli::Size> size;
  add_reproduce_options(app, options, size);
  if (!cli::parse(app, arguments)) return false;
  options.size = size.value_or(options.quick ? cli::Size{192, 108} : cli::Size{640, 360});
  cli::check_together(static_cast<const cli::SceneOptions&>(options));
  check_together(static_cast<const session::CacheOptions&>(options));
  cli::check_together(static_cast<const cli::DeviceOptions&>(options));
  return true;
}

// "12 %, 1:14 left", by what each figure is expected to take.
class FigureProgress {
 public:
  explicit FigureProgress(bool wanted) : progress_("", all(), wanted) {}

  void drawn() { progress_.set_done(std::min(++at_, end_)); }
  void next(int pictures) {
    at_ = end_;
    progress_.set_done(at_);
    end_ += pictures;
  }

 private:
  static int all() {
    int pictures = references;
    for (const Entry& entry : figures) pictures += entry.pictures;
    return pictures;
  }

  cli::Progress progress_;
  int at_ = 0, end_ = references;
};

}  // namespace

int run(const cli::Arguments& arguments) {
  Options options;
  if (!parse(arguments, options)) return 0;
  if (options.scene.empty()) options.scene = shipped_scene("thesis.glb");
  options.moving_scene = shipped_scene("moving.glb");
  cli::clean_up_on_signals();
  session::limit_threads(options);
  const std::array<std::filesystem::path, 2> scenes{options.scene, options.moving_scene};
  check_inputs(options, scenes);
  for (const std::filesystem::path& path : {options.page(), options.json(), options.csv()}) io::check_writable(path);

  FigureProgress progress(!options.quiet);
  Workbench bench(options, [&progress] { progress.drawn(); });
  std::vector<Finding> findings;
  for (const Entry& entry : figures) {
    progress.next(entry.pictures);
    findings.push_back(entry.make(bench));
  }
  io::write_text(options.json(), io::text_of(json_of(findings, bench)));
  io::write_text(options.csv(), csv_of(findings));
  io::write_text(options.page(), report::to_text(page_of(findings, bench, arguments)));
  if (!options.quiet) fmt::print("{}wrote {}\n", text_of(findings, options), cli::printable(options.page().string()));
  return 0;
}

}  // namespace penumbra::reproduce

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/render/drawing.h"
#include "app/render/file_check.h"
#include "app/render/frame_files.h"
#include "app/render/options.h"
#include "cli/output_names.h"
#include "cli/signals.h"
#include "cli/text.h"
#include "image/read.h"
#include "io/output_file.h"
#include "io/report.h"
#include "render/aov_picture.h"
#include "session/file_watch.h"
#include "session/prepared_scene.h"
#include "session/render_session.h"
#include "session/shader_reload.h"
#include "session/techniques.h"
#include "truth/technique.h"

namespace penumbra::app {

namespace {

namespace fs = std::filesystem;

using Paths = std::vector<fs::path>;

bool is_among(const fs::path& file, const Paths& files) { return std::ranges::find(files, file) != files.end(); }

// Flushed at once, so that a reader of a pipe sees it.
void print_line(const std::string& line) {
  fmt::print("{}\n", cli::printable(line));
  if (std::fflush(stdout) != 0) fail("cannot write to standard output");
}

// A shader's faults are a line each.
void print_error(std::string_view message) {
  std::string text = "error: ";
  for (std::size_t begin = 0; begin <= message.size();) {
    const std::size_t end = std::min(message.find('\n', begin), message.size());
    text += cli::printable(std::string(message.substr(begin, end - begin))) + '\n';
    begin = end + 1;
  }
  std::fputs(text.c_str(), stderr);
}

// "a.glsl, b.glsl and 3 more"
std::string names_of(const Paths& files) {
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(files.size(), most); ++i) text += (i == 0 ? "" : ", ") + files[i].string();
  if (files.size() > most) text += fmt::format(" and {} more", files.size() - most);
  return text;
}

// Describes how far two pictures of display values (0 to 255) differ.
std::string difference(const std::vector<std::uint8_t>& before, const std::vector<std::uint8_t>& now) {
  double sum = 0;
  int most = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const int error = std::abs(int{now[i]} - int{before[i]});
    sum += error;
    most = std::max(most, error);
  }
  if (most == 0) return "the same picture as before";
  return fmt::format("differs by {:.3f} of 255 in the mean, {} at most", sum / static_cast<double>(now.size()), most);
}

// One picture, drawn again whenever a file that it depends on changes.
class Watch {
 public:
  explicit Watch(RenderOptions options);

  void run();  // until a signal ends the program

 private:
  struct Change {
    Paths files;
    std::size_t rebuilt = 0;  // programs
    double seconds = 0;       // to compile them
    bool reported = false;    // the errors of those that failed
  };

  Paths inputs() const;
  void take(const Paths& changed);
  void update(const Change& change);
  void reload_scene();
  bool draw();
  std::string report(const Change& change);
  void print_faults();

  RenderOptions options_;
  cli::OutputNames names_;
  session::FileWatch files_;
  Paths named_;  // by the scene file when it was read last, whether or not they could be read
  ParamSet params_;
  truth::TruthTechnique truth_;
  std::unique_ptr<session::PreparedScene> prepared_;
  std::unique_ptr<session::RenderSession> session_;
  // What has changed and is not yet read or drawn, because it is new or because the last attempt failed.
  bool params_due_ = false, scene_due_ = false, picture_due_ = true;
  std::vector<std::uint8_t> shown_;  // the last picture that was written
};

Watch::Watch(RenderOptions options)
    : options_(std::move(options)),
      names_(options_.output, /* sequence= */ false),
      params_(params_of(options_)),
      truth_(session::truth_options(options_, options_)) {
  check_files(options_, names_);
  files_.set_files(inputs());
  if (!options_.glsl.empty()) files_.add_folder(options_.glsl);
  params_ = params_of(options_);  // files may have changed before the watch began
  warn_without_effect(options_, params_);
  options_.reading.skies_chosen = cli::is_chosen(options_, params_, "casters.skies");
  options_.reading.names_files = [this](const Paths& files) { named_ = files; };
  prepared_ = std::make_unique<session::PreparedScene>(
      session::load_scene(options_, image::image_decoder(cli::limits_of(options_.reading))));
  check_scene_files(prepared_->scene.files, options_, names_);
  cli::warn_without_lights(options_, options_, session::kinds_of_light(*prepared_));
  files_.set_files(inputs());
  session_ = std::make_unique<session::RenderSession>(options_, options_, session::open_context(options_, options_),
                                                      *prepared_, truth_.registry(), /* timed= */ true);
}

// The single files to watch: the scene's, including those that could not be read, those of the scene that is shown,
// and the presets.
Paths Watch::inputs() const {
  Paths files{options_.scene};
  files.insert(files.end(), named_.begin(), named_.end());
  if (prepared_) files.insert(files.end(), prepared_->scene.files.begin(), prepared_->scene.files.end());
  files.insert(files.end(), options_.presets.begin(), options_.presets.end());
  return files;
}

void Watch::run() {
  Paths watched{options_.scene};
  watched.insert(watched.end(), options_.presets.begin(), options_.presets.end());
  if (!options_.glsl.empty()) watched.emplace_back(options_.glsl);
  if (!options_.quiet) print_line(fmt::format("watching {}; Ctrl-C ends", names_of(watched)));
  update({});
  while (true) {
    try {
      take(files_.poll(std::chrono::hours(1)));
    } catch (const Error& error) {  // the system's limit of watches is reached: the earlier watches remain
      print_error(error.what());
    }
  }
}

void Watch::take(const Paths& changed) {
  const Paths presets(options_.presets.begin(), options_.presets.end());
  Change change;
  for (const fs::path& file : changed) {
    const bool is_preset = is_among(file, presets);
    const bool is_scene = file == options_.scene || is_among(file, named_) || is_among(file, prepared_->scene.files);
    params_due_ |= is_preset;
    scene_due_ |= is_scene;
    if (is_preset || is_scene) change.files.push_back(file);
  }
  const session::ShaderReload reload = session::reload_shaders(session_->device().shaders, changed);
  change.reported = reload.failed > 0;
  if (change.reported) print_faults();
  change.files.insert(change.files.end(), reload.files.begin(), reload.files.end());
  change.rebuilt = reload.rebuilt;
  change.seconds = reload.seconds;
  picture_due_ |= params_due_ || scene_due_ || reload.redraws();
  if (picture_due_ && !change.files.empty()) update(change);
}

// What fails now is tried again after the next change.
void Watch::update(const Change& change) {
  std::string line;
  try {
    if (params_due_) params_ = params_of(options_);
    params_due_ = false;
    if (scene_due_) reload_scene();
    scene_due_ = false;
    if (!draw()) {
      if (!change.reported) print_faults();
      return;
    }
    picture_due_ = false;
    line = report(change);
  } catch (const Error& error) {
    print_error(error.what());
    return;
  }
  if (!options_.quiet) print_line(line);
}

// Programs that fail for the same lines are one fault.
void Watch::print_faults() {
  for (const std::string& error : session::shader_faults(session_->device().shaders)) print_error(error);
}

void Watch::reload_scene() {
  std::unique_ptr<session::PreparedScene> prepared;
  try {
    prepared = std::make_unique<session::PreparedScene>(
        session::load_scene(options_, image::image_decoder(cli::limits_of(options_.reading))));
  } catch (const Error&) {
    files_.set_files(inputs());  // a file that the new scene lacks may appear
    throw;
  }
  check_scene_files(prepared->scene.files, options_, names_);
  session_->show(*prepared);
  prepared_ = std::move(prepared);
  files_.set_files(inputs());
}

// Returns false if a shader that it needs does not compile: then the last picture stays.
bool Watch::draw() {
  constexpr int frame = 0;
  gl::ShaderLibrary& shaders = session_->device().shaders;
  shaders.take_outdated();
  session_->cut();
  bool written = false;
  draw_frames(options_, *session_, params_, {frame, frame}, [&](int) {
    if (shaders.take_outdated()) return;
    write_frame(*session_, options_, params_, names_, frame);
    written = true;
  });
  return written;
}

// Measures the picture, writes the reports, and returns a line about all of it.
std::string Watch::report(const Change& change) {
  std::vector<std::uint8_t> display = render::display_bytes(session_->renderer().read_display(), options_.size.width,
                                                            options_.size.height, options_.supersample)
                                          .pixels;
  std::string facts;
  if (change.rebuilt > 0) {
    facts = fmt::format(", {} program{} rebuilt in {:.1f} ms", change.rebuilt, change.rebuilt == 1 ? "" : "s",
                        change.seconds * 1e3);
  }
  if (!shown_.empty()) facts += ", " + difference(shown_, display);
  shown_ = std::move(display);
  const std::size_t measured = measure(options_, *session_, params_, {});
  write_reports(options_, *prepared_, params_, *session_, measured);
  const std::vector<gl::Timers::Row> rows = session_->device().timers.rows();
  const double cost = io::pass_costs(std::span(rows).last(1), measured).front().median;
  return fmt::format("{}wrote {} ({}×{}, {}, frame {:.1f} ms{})",
                     change.files.empty() ? "" : names_of(change.files) + " changed: ", options_.output,
                     options_.size.width, options_.size.height, session::technique_label(params_), cost, facts);
}

void check_watchable(const RenderOptions& options) {
  if (options.frame) cli::fail_usage("--frame is not for watch, which draws one picture: see --time");
  if (options.frames) cli::fail_usage("--frames is not for watch, which draws one picture: see --time");
  for (const std::string& preset : options.presets) {
    if (!options.save_preset.empty() && io::would_replace(options.save_preset, preset))
      cli::fail_usage("--save-preset {} would change a preset that is watched", io::quoted(options.save_preset));
  }
}

}  // namespace

int run_watch(const Arguments& arguments) {
  CLI::App app("Draw a picture as render does, and again whenever its scene, a preset file or a shader is saved",
               "penumbra watch");
  RenderOptions options;
  add_render_options(app, options);
  for (const char* name : {"--frames", "--frame", "--fps"}) app.get_option(name)->group("");  // not in --help
  if (!cli::parse(app, arguments)) return 0;
  check_together(options);
  check_watchable(options);
  cli::clean_up_on_signals();
  session::limit_threads(options);
  Watch(std::move(options)).run();
  return 0;
}

}  // namespace penumbra::app

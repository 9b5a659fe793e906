#include "viewer/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <utility>

#include "cli/signals.h"
#include "cli/text.h"
#include "io/output_file.h"
#include "io/presets.h"
#include "io/program_path.h"
#include "session/render_session.h"
#include "session/shader_reload.h"
#include "session/techniques.h"
#include "viewer/clipped.h"

namespace penumbra::viewer {

namespace {

volatile std::sig_atomic_t caught_signal = 0;

void set_signals() {
  struct sigaction action {};
  action.sa_handler = [](int number) { caught_signal = number; };
  for (const int signal : cli::ending_signals()) sigaction(signal, &action, nullptr);
  // If it is ignored, nobody learns the exit code of a program that writes a picture.
  std::signal(SIGCHLD, SIG_DFL);
}

// The document of the command line.
Document document_of(const ViewOptions& options) {
  Document document;
  document.options = static_cast<const cli::SceneOptions&>(options);
  document.options.frames = cli::FrameRange{};
  auto shadows = static_cast<const cli::ShadowOptions&>(options);
  shadows.otherwise = session::usual_technique;
  document.params = cli::resolve_params(shadows, session::all_techniques());
  document.options.reading.skies_chosen = cli::is_chosen(options, document.params, "casters.skies");
  return document;
}

Window::Options window_options(const ViewOptions& options, const Settings& settings) {
  const cli::Size size = options.sized ? options.size : settings.window.value_or(options.size);
  return {.width = size.width, .height = size.height, .debug = session::debug_wanted(options)};
}

// The scene that comes with the program, installed or in the source tree; empty if there is none.
std::string own_scene() {
  std::error_code fault;
  const std::filesystem::path folder = io::program_path(fault).parent_path();
  for (const char* place : {"../share/penumbra/scenes/courtyard.glb", "../../scenes/courtyard.glb"}) {
    if (std::filesystem::exists(folder / place, fault)) return (folder / place).lexically_normal().string();
  }
  return "";
}

std::string first_scene(const ViewOptions& options, const Settings& settings) {
  if (!options.scene.empty()) return options.scene;
  for (const std::string& recent : settings.recent) {
    std::error_code fault;
    if (std::filesystem::exists(recent, fault)) return recent;
  }
  return own_scene();
}

}  // namespace

Viewer::Viewer(ViewOptions options)
    : options_(std::move(options)),
      settings_(options_.defaults ? Settings{} : read_settings(fault_)),
      window_(window_options(options_, settings_)),
      device_(options_),
      truth_(session::truth_options(options_, options_, {.background = true})),
      renderer_(device_.device, truth_.registry()),
      a_(device_.device, renderer_, 0),
      b_(device_.device, renderer_, 1),
      pacing_(device_.info.software),
      status_{.techniques = renderer_.registry(),
              .device = device_.info,
              .gl = device_.device,
              .costs_a = a_.costs,
              .costs_b = b_.costs} {
  state_.document = document_of(options_);
  take_settings();
  take_preset_option();
  guarded([&] {
    watch_.emplace();
    if (!options_.glsl.empty()) watch_->add_folder(options_.glsl);
  });
}

Viewer::~Viewer() { truth_.stop(); }

int Viewer::run() {
  set_signals();
  const std::string scene = first_scene(options_, settings_);
  state_.document.options.scene = options_.scene = scene;
  if (!scene.empty()) open(scene);
  try {
    show_frames();
  } catch (...) {
    keep_settings();
    throw;
  }
  keep_settings();
  return caught_signal == 0 ? 0 : 128 + caught_signal;
}

void Viewer::show_frames() {
  while (caught_signal == 0 && !ended_) {
    window_.poll(pause());
    if (window_.take_close()) state_.requests.quit = true;
    if (window_.pixels().x == 0 || window_.pixels().y == 0) {
      if (closes()) break;
      window_.poll(0.1);
      continue;
    }
    frame();
    if (closes()) break;
    do_requests();
  }
}

// Seconds that the viewer waits for input before its next frame.
double Viewer::pause() const {
  const bool rests = device_.info.software && ImGui::GetTime() - last_draw_ > 0.5 && loader_.file().empty();
  if (rests) return 0.1;
  const bool waits = !interface_changed_ && contents() == presented_contents_ && unsettled_ == 0;
  constexpr double often = 0.002, seldom = 0.02;  // a playing animation needs its next frame in time
  return !waits ? 0 : state_.playback.playing ? often : seldom;
}

void Viewer::guarded(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    tell_error(state_, error.what(), ImGui::GetTime());
  }
}

void Viewer::frame() {
  turn_.begin();
  take_events();
  unsettled_ = window_.has_presses() ? settling : std::max(unsettled_ - 1, 0);
  begin_interface();
  play(ImGui::GetIO().DeltaTime);
  const PictureArea area = build_interface();
  if (std::exchange(dragging_, area.dragging) && !area.dragging) {
    unsettled_ = 0;
    pacing_.end_motion();
  }
  guarded([&] { update_view(); });
  std::optional<PictureWork> work;
  guarded([&] { work = plan_pictures(area, ImGui::GetTime()); });
  if (work && !work->plan.at_rest) guarded([&] { draw_pictures(*work); });
  guarded([&] { probe(area); });
  guarded([&] { read_texel(area); });
  guarded([&] { show_pictures(); });
  // Also the faults of programs that were unused when the shader was saved, and are compiled only now.
  if (device_.device.shaders.take_outdated() || !status_.shader_errors.empty())
    status_.shader_errors = session::shader_faults(device_.device.shaders);
  if (status_.idle) widgets_.mark_idle();
  show_interface();
  cost_reader_.read(device_.device.timers, ImGui::GetTime());
  if (std::exchange(vsync_, state_.vsync) != state_.vsync) window_.set_vsync(state_.vsync);
  turn_.end();
  if (work && work->plan.at_rest) draw_at_rest(*work);
}

void Viewer::begin_interface() {
  window_.set_user_scale(state_.scale);
  window_.begin();
  widgets_.begin();
}

void Viewer::show_interface() {
  gl::leave_initial_state();
  interface_changed_ = window_.show(presents_);
  if (options_.layout.empty()) return;
  mark_clipped(widgets_);
  guarded([&] { widgets_.write_changes(options_.layout); });
}

// Gives the window's input to the interface, and draws that over the last picture. A picture that the user has changed
// meanwhile is given up.
void Viewer::attend() {
  window_.poll(0);
  if (window_.has_news() || caught_signal != 0) throw GivenUp();
  if (window_.has_input()) answer(settling);
}

void Viewer::take_events() {
  for (const std::string& path : window_.dropped()) {
    std::optional<std::string>& taken = is_preset(path) ? state_.requests.open_preset : state_.requests.open;
    if (taken) tell(state_, "of the files dropped together, only the last is opened", ImGui::GetTime());
    taken = path;
  }
  take_loaded();
  take_saved();
  take_written();
  status_.command = cli::command_text("penumbra", command());
}

// The scene that has been read, if one has. Why one could not be read stays in a window without a scene.
std::optional<SceneLoader::Loaded> Viewer::finished_scene() {
  try {
    std::optional<SceneLoader::Loaded> loaded = loader_.finished();
    if (loaded || !loader_.file().empty()) status_.load_error.clear();
    return loaded;
  } catch (const std::exception& error) {
    status_.load_error = error.what();
    failed_loads_.emplace_back(error.what());
    throw;
  }
}

void Viewer::take_loaded() {
  // A question is about the scene that is shown.
  if (state_.closing.wanted || state_.closing.asks) return;
  guarded([&] {
    std::optional<SceneLoader::Loaded> loaded = finished_scene();
    status_.loading = loader_.file().empty() ? "" : std::filesystem::path(loader_.file()).filename().string();
    if (!loaded) return;
    for (const std::string& error : std::exchange(failed_loads_, {})) withdraw(state_, error);
    cli::SceneOptions& options = state_.document.options;
    const bool is_first = scene_ == nullptr, is_other = options.scene != loaded->options.scene;
    if (is_other && changed_while_loading()) {
      loader_.forget();
      state_.closing = {.wanted = true, .scene = loaded->options.scene};
      return;
    }
    truth_.stop();
    auto scene = std::make_unique<LoadedScene>(device_.device, std::move(loaded->prepared));
    scene_ = std::move(scene);
    status_.scene = scene_.get();
    const cli::Size size = options.size;
    // A scene that was saved again keeps the camera, sun and time that the user has chosen.
    if (is_other) {
      options = loaded->options;
      options.size = size;
      state_.document.frame = 0;
    }
    if (is_other || scene_->prepared.scene.animations.empty()) state_.playback = {.speed = state_.playback.speed};
    if (is_first || is_other) take_view();
    use_light_indices(options, scene_->lights);
    if (is_first || is_other) {
      history_.start(present_edit());
      note_saved_view();
    }
    state_.scene_file = loaded->options.scene;
    add_recent(state_.recent, loaded->options.scene);
    for (Side* side : {&a_, &b_}) {
      side->renderer.cut();
      side->costs.clear();
    }
    view_options_.clear();
    a_.failed = b_.failed = {};
    if (watch_) watch_->set_files(scene_->prepared.scene.files);
  });
}

// Loads the scene that is shown. Its lights and cameras may be others now: update_view() chooses once it is read.
void Viewer::load_again() {
  cli::SceneOptions options = state_.document.options;
  use_scene_view(options);
  loader_.start(std::move(options));
}

// Loads saved files again: the scene's, and shaders.
void Viewer::take_saved() {
  if (!watch_) return;
  guarded([&] {
    const std::vector<std::filesystem::path> changed = watch_->poll();
    const auto is_saved = [&](const std::filesystem::path& file) {
      return std::find(changed.begin(), changed.end(), file) != changed.end();
    };
    const cli::SceneOptions& shown = state_.document.options;
    const cli::SceneOptions& asked = loader_.asked();
    // Another scene is being read, or could not be.
    const bool is_other = scene_ == nullptr || asked.scene != shown.scene;
    if (is_other && is_saved(asked.scene)) {
      loader_.start(asked);
    } else if (scene_ != nullptr && (!is_other || loader_.file().empty())) {
      const std::vector<std::filesystem::path>& files = scene_->prepared.scene.files;
      if (std::any_of(files.begin(), files.end(), is_saved)) load_again();
    }
    if (!changed.empty() && !options_.glsl.empty()) take_shaders(changed);
  });
}

void Viewer::take_shaders(std::span<const std::filesystem::path> changed) {
  const session::ShaderReload reload = session::reload_shaders(device_.device.shaders, changed);
  if (reload.files.empty()) return;
  status_.shader_errors = reload.errors;
  if (!reload.redraws()) return;
  a_.renderer.cut();
  b_.renderer.cut();
  const std::string compiled = "programs compiled: ";  // editors save often: only the last one is shown
  tell(state_, fmt::format("{}{}, in {:.2f} s; histories start again", compiled, reload.rebuilt, reload.seconds),
       ImGui::GetTime(), compiled);
}

void Viewer::play(float seconds) {
  Playback& playback = state_.playback;
  if (!playback.playing || scene_ == nullptr || scene_->prepared.scene.animations.empty()) return;
  playback.carried += std::min(seconds, 0.25f) * playback.speed * state_.document.options.fps;
  const double whole = std::floor(playback.carried);
  playback.carried -= whole;
  state_.document.step(static_cast<int>(whole));
}

// Chooses camera and sun as `render` would for the present options.
void Viewer::update_view() {
  if (scene_ == nullptr) return;
  cli::SceneOptions& options = state_.document.options;
  options.size = {window_size_.x, window_size_.y};
  std::string wanted = cli::command_text("", scene_arguments(options));
  if (wanted == view_options_) return;
  try {
    session::update_view(scene_->prepared, options);
  } catch (const Error& error) {
    leave_out_unknown();
    history_.amend(present_edit());  // it is no step of the user's
    tell_error(state_, fmt::format("{}: {}", io::quoted(options.scene), error.what()), ImGui::GetTime());
    wanted = cli::command_text("", scene_arguments(options));
  }
  view_options_ = std::move(wanted);
}

// Leaves out of the view what the scene lacks: lights or a camera that were saved with it, or chosen before it was
// saved with others. Where that does not help, the view is the scene's own.
void Viewer::leave_out_unknown() {
  const cli::SceneOptions chosen = state_.document.options;
  cli::SceneOptions without_lights = chosen, without_camera = chosen, without_both = chosen, own = chosen;
  without_lights.lights.reset();
  without_camera.camera.reset();
  without_both.lights.reset();
  without_both.camera.reset();
  use_scene_view(own);
  for (const cli::SceneOptions& fitting : {without_lights, without_camera, without_both, own}) {
    try {
      session::update_view(scene_->prepared, fitting);
      state_.document.options = fitting;
      return;
    } catch (const Error&) {
      continue;
    }
  }
}

}  // namespace penumbra::viewer

#include "viewer/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <utility>

#include "cli/text.h"
#include "io/presets.h"
#include "session/render_session.h"
#include "session/shader_reload.h"
#include "session/techniques.h"

namespace penumbra::viewer {

namespace {

constexpr float panel_width = 390, least_picture = 240;

volatile std::sig_atomic_t caught_signal = 0;

void end_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int number) { caught_signal = number; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

// The first document: what the command line says.
Document document_of(const ViewOptions& options) {
  Document document;
  document.options = options;
  document.options.frames = cli::FrameRange{};
  document.params = cli::resolve_params(options, session::all_techniques());
  return document;
}

Window::Options window_options(const ViewOptions& options, const Settings& settings) {
  const cli::Size size = options.sized ? options.size : settings.window.value_or(options.size);
  return {.width = size.width, .height = size.height, .debug = session::debug_wanted(options)};
}

// The one that comes with the program, installed or in its sources' folder; empty: there is none.
std::string own_scene() {
  std::error_code fault;
  const std::filesystem::path folder = std::filesystem::read_symlink("/proc/self/exe", fault).parent_path();
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
      device_info_(gl::device_info()),
      device_(gl::ShaderFiles(options_.glsl), session::timing_of(device_info_)),
      truth_({.cache = options_.folder(), .threads = options_.threads.value_or(0), .background = true}),
      renderer_(device_, truth_.registry()),
      a_(device_, renderer_, 0),
      b_(device_, renderer_, 1),
      pace_(device_info_.software),
      facts_{.techniques = renderer_.registry(),
             .device = device_info_,
             .gl = device_,
             .costs_a = a_.costs,
             .costs_b = b_.costs} {
  state_.document = document_of(options_);
  take_settings();
  guarded([&] {
    watch_.emplace();
    if (!options_.glsl.empty()) watch_->add_folder(options_.glsl);
  });
}

Viewer::~Viewer() { truth_.stop(); }

int Viewer::run() {
  end_on_signals();
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
  double last = ImGui::GetTime();
  while (caught_signal == 0) {
    const bool still = device_info_.software && ImGui::GetTime() - last_draw_ > 0.5 && loader_.file().empty();
    if (!window_.poll(still ? 0.1 : 0.0)) break;
    if (window_.pixels().x == 0 || window_.pixels().y == 0) {
      window_.poll(0.1);
      continue;
    }
    const double now = ImGui::GetTime();
    frame(static_cast<float>(now - last));
    last = now;
    if (state_.requests.quit) break;
    do_requests();
  }
}

void Viewer::guarded(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    tell_error(state_, error.what(), ImGui::GetTime());
  }
}

void Viewer::frame(float seconds) {
  take_events();
  window_.begin();
  widgets_.begin();
  play(seconds);
  const PictureArea area = build_interface(seconds);
  guarded([&] { aim(); });
  guarded([&] { draw_pictures(area, ImGui::GetTime()); });
  guarded([&] { probe(area); });
  guarded([&] { show_pictures(); });
  gl::leave_initial_state();
  // Also what a program that was idle at the save tells only now.
  if (device_.shaders.take_outdated() || !facts_.shader_errors.empty())
    facts_.shader_errors = session::shader_faults(device_.shaders);
  if (facts_.at_rest) widgets_.mark_rest();
  window_.show();
  cost_reader_.read(device_.timers, ImGui::GetTime());
  if (!options_.layout.empty()) guarded([&] { widgets_.write_changes(options_.layout); });
  if (std::exchange(vsync_, state_.vsync) != state_.vsync) window_.set_vsync(state_.vsync);
}

void Viewer::take_events() {
  for (const std::string& path : window_.dropped()) {
    (is_preset(path) ? state_.requests.open_preset : state_.requests.open) = path;
  }
  take_loaded();
  take_saved();
  take_written();
  facts_.command = cli::command_text("penumbra", command());
}

void Viewer::take_loaded() {
  guarded([&] {
    std::optional<SceneLoader::Loaded> loaded = loader_.finished();
    facts_.loading = loader_.file().empty() ? "" : std::filesystem::path(loader_.file()).filename().string();
    if (!loaded) return;
    truth_.stop();
    auto scene = std::make_unique<LoadedScene>(device_, std::move(loaded->prepared));
    scene_ = std::move(scene);
    facts_.scene = scene_.get();
    const cli::Size size = state_.document.options.size;
    // A scene that was saved again is seen as it was: what was changed meanwhile stays.
    if (state_.document.options.scene != loaded->options.scene) {
      state_.document.options = loaded->options;
      state_.document.options.size = size;
      state_.document.frame = 0;
    }
    state_.scene_file = loaded->options.scene;
    add_recent(state_.recent, loaded->options.scene);
    for (Side* side : {&a_, &b_}) {
      side->painter.cut();
      side->costs.clear();
    }
    aimed_.clear();
    window_.set_title(std::filesystem::path(loaded->options.scene).filename().string() + " - Penumbra");
    if (watch_) watch_->set_files(scene_->prepared.scene.files);
  });
}

// Files of the scene and shaders, as they are saved.
void Viewer::take_saved() {
  if (!watch_) return;
  guarded([&] {
    const std::vector<std::filesystem::path> changed = watch_->poll();
    const auto is_saved = [&](const std::filesystem::path& file) {
      return std::find(changed.begin(), changed.end(), file) != changed.end();
    };
    const cli::SceneOptions& shown = state_.document.options;
    const cli::SceneOptions& asked = loader_.asked();
    // One that is being read, or that could not be.
    const bool is_other = scene_ == nullptr || asked.scene != shown.scene;
    if (is_other && is_saved(asked.scene)) {
      loader_.start(asked);
    } else if (scene_ != nullptr && (!is_other || loader_.file().empty())) {
      const std::vector<std::filesystem::path>& files = scene_->prepared.scene.files;
      if (std::any_of(files.begin(), files.end(), is_saved)) loader_.start(shown);
    }
    if (!changed.empty() && !options_.glsl.empty()) take_shaders(changed);
  });
}

void Viewer::take_shaders(std::span<const std::filesystem::path> changed) {
  const session::ShaderReload reload = session::reload_shaders(device_.shaders, changed);
  if (reload.files.empty()) return;
  facts_.shader_errors = reload.errors;
  if (!reload.redraws()) return;
  a_.painter.cut();
  b_.painter.cut();
  // One of a kind: editors save often.
  std::erase_if(state_.messages, [](const Message& message) { return message.text.starts_with("programs compiled"); });
  tell(state_,
       fmt::format("programs compiled: {}, in {:.2f} s; what techniques remember begins anew", reload.rebuilt,
                   reload.seconds),
       ImGui::GetTime());
}

void Viewer::play(float seconds) {
  Playback& playback = state_.playback;
  if (!playback.playing || scene_ == nullptr || scene_->prepared.scene.animations.empty()) return;
  playback.carried += std::min(seconds, 0.25f) * playback.speed * state_.document.options.fps;
  const double whole = std::floor(playback.carried);
  playback.carried -= whole;
  state_.document.step(static_cast<int>(whole));
}

PictureArea Viewer::build_interface(float seconds) {
  const Panel panel{state_, facts_, widgets_};
  take_keys(panel, seconds);
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;
  const float width = std::min(panel_width * window_.scale(), std::max(whole.x - least_picture, 0.0f));
  const float left = state_.panel ? width : 0.0f;
  const float bar = ImGui::GetFrameHeight() + 4 * window_.scale();
  if (state_.panel) {
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({width, whole.y});
    if (ImGui::Begin("panel", nullptr, fixed)) side_panel(panel);
    ImGui::End();
  }
  ImGui::SetNextWindowPos({left, 0});
  ImGui::SetNextWindowSize({whole.x - left, whole.y - bar});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("picture", nullptr, fixed | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  const ImVec2 dots = ImGui::GetIO().DisplayFramebufferScale;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  window_size_ = glm::max(glm::ivec2(room.x * dots.x, room.y * dots.y), 1);
  const gl::Texture* seen = a_.seen == nullptr
                                ? nullptr
                                : &device_.target("viewer/window", {.width = window_size_.x, .height = window_size_.y});
  const PictureArea area = picture_area(panel, seen);
  ImGui::End();
  ImGui::SetNextWindowPos({left, whole.y - bar});
  ImGui::SetNextWindowSize({whole.x - left, bar});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10 * window_.scale(), 2 * window_.scale()});
  ImGui::Begin("status", nullptr, fixed | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  status_bar(panel);
  ImGui::End();
  const ImVec2 corner(area.corner.x, area.corner.y);
  shader_errors_overlay(panel, corner);
  legend_overlay(panel, {corner.x + area.size.x, corner.y});
  messages_overlay(panel, {corner.x, corner.y + area.size.y}, ImGui::GetTime());
  help_overlay(panel);
  state_.list_open = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  return area;
}

void Viewer::side_panel(const Panel& panel) {
  struct Tab {
    const char* name;
    void (*draw)(const Panel&);
  };
  static constexpr std::array tabs{Tab{"Shadow", shadow_panel},   Tab{"Scene", scene_panel},
                                   Tab{"Inspect", inspect_panel}, Tab{"Compare", compare_panel},
                                   Tab{"Cost", cost_panel},       Tab{"Files", files_panel}};
  if (!ImGui::BeginTabBar("tabs")) return;
  for (const Tab& tab : tabs) {
    const bool wanted = state_.focus_search ? tab.draw == shadow_panel : state_.tab == tab.name;
    const bool open = ImGui::BeginTabItem(tab.name, nullptr, wanted ? ImGuiTabItemFlags_SetSelected : 0);
    panel.widgets.mark(std::string("tab ") + tab.name);
    if (!open) continue;
    state_.open_tab = tab.name;
    tab.draw(panel);
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
  state_.tab.clear();
}

// Camera and sun as `render` would choose them for these options.
void Viewer::aim() {
  if (scene_ == nullptr) return;
  cli::SceneOptions& options = state_.document.options;
  options.size = {window_size_.x, window_size_.y};
  std::string wanted = cli::command_text("", scene_arguments(options));
  if (wanted == aimed_) return;
  session::update_view(scene_->prepared, options);
  aimed_ = std::move(wanted);
}

}  // namespace penumbra::viewer

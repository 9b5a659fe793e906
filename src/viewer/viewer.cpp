#include "viewer/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <utility>

#include "cli/text.h"
#include "io/presets.h"
#include "session/render_session.h"
#include "session/shader_reload.h"
#include "session/techniques.h"
#include "viewer/clipped.h"

namespace penumbra::viewer {

namespace {

// Pixels at an interface scale of 1. A panel that is wider than `enough_for_panel` cuts nothing off.
constexpr float least_picture = 240, enough_for_panel = 380;
constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

volatile std::sig_atomic_t caught_signal = 0;

void end_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int number) { caught_signal = number; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
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
  while (caught_signal == 0 && !ended_) {
    const bool still = device_.info.software && ImGui::GetTime() - last_draw_ > 0.5 && loader_.file().empty();
    window_.poll(still ? 0.1 : 0.0);
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

void Viewer::guarded(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    tell_error(state_, error.what(), ImGui::GetTime());
  }
}

void Viewer::frame() {
  const auto start = std::chrono::steady_clock::now();
  drawn_milliseconds_ = 0;
  take_events();
  unsettled_ = window_.has_presses() ? settling : std::max(unsettled_ - 1, 0);
  begin_interface();
  play(ImGui::GetIO().DeltaTime);
  const PictureArea area = build_interface();
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
  if (drawn_milliseconds_ > 0) {
    const std::chrono::duration<double, std::milli> all = std::chrono::steady_clock::now() - start;
    beside_pictures_ = all.count() - drawn_milliseconds_;
  }
  if (work && work->plan.at_rest) draw_at_rest(*work);
}

void Viewer::begin_interface() {
  window_.set_user_scale(state_.scale);
  window_.begin();
  widgets_.begin();
}

void Viewer::show_interface() {
  gl::leave_initial_state();
  window_.show();
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

// Draws so many frames of the interface, and more while there is input.
void Viewer::answer(int frames) {
  attending_ = true;
  for (int left = frames; left > 0; left = window_.has_input() ? settling : left - 1) {
    begin_interface();
    build_interface();
    widgets_.mark_drawing();
    show_interface();
    if (wishes() != begun_) throw GivenUp();
  }
  attending_ = false;
}

// A picture at rest is seen as soon as it has one sample of each pixel. Values are those of finished pictures.
void Viewer::show_first_sample(Side& side) {
  if (!state_.inspection.what.empty()) return;
  side.shown = &side.renderer.picture();
  status_.detail = {};
  status_.drawn_size = {side.shown->width(), side.shown->height()};
  show_pictures();
  answer(1);
}

void Viewer::take_events() {
  for (const std::string& path : window_.dropped()) {
    (is_preset(path) ? state_.requests.open_preset : state_.requests.open) = path;
  }
  take_loaded();
  take_saved();
  take_written();
  status_.command = cli::command_text("penumbra", command());
}

void Viewer::take_loaded() {
  guarded([&] {
    std::optional<SceneLoader::Loaded> loaded = loader_.finished();
    status_.loading = loader_.file().empty() ? "" : std::filesystem::path(loader_.file()).filename().string();
    if (!loaded) return;
    truth_.stop();
    cli::SceneOptions& options = state_.document.options;
    const bool is_first = scene_ == nullptr, is_other = options.scene != loaded->options.scene;
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
    if (watch_) watch_->set_files(scene_->prepared.scene.files);
  });
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
      if (std::any_of(files.begin(), files.end(), is_saved)) loader_.start(shown);
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
  // Replaces the last message of this kind: editors save often.
  std::erase_if(state_.messages, [](const Message& message) { return message.text.starts_with("programs compiled"); });
  tell(state_, fmt::format("programs compiled: {}, in {:.2f} s; histories start again", reload.rebuilt, reload.seconds),
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

// The panel is beside the picture where the window is wide enough for both, else between picture and status line.
// `menus`: the menus' height.
Viewer::Places Viewer::places(bool with_panel, float menus) const {
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  const float scale = window_.scale(), bar = ImGui::GetFrameHeight() + 4 * scale;
  const float height = std::max(whole.y - menus - bar, 1.0f);  // without menus and status line
  Places places;
  places.beside = whole.x >= (enough_for_panel + least_picture) * scale;
  float left = 0, low = 0;  // what the panel takes from the picture
  if (places.beside) {
    const float width =
        std::clamp(state_.panel_width * scale, enough_for_panel * scale, whole.x - least_picture * scale);
    places.panel = {{0, menus}, {width, std::max(whole.y - menus, 1.0f)}};
    if (with_panel) left = width;
  } else {
    const float part = std::max(std::round(height * state_.panel_share), 1.0f);
    places.panel = {{0, menus + height - part}, {whole.x, part}};
    if (with_panel) low = part;
  }
  places.picture = {{left, menus}, {whole.x - left, std::max(height - low, 1.0f)}};
  places.status = {{left, whole.y - bar}, {whole.x - left, bar}};
  return places;
}

PictureArea Viewer::build_interface() {
  const Panel panel{state_, status_, widgets_};
  take_keys(panel, ImGui::GetIO().DeltaTime);
  const bool with_panel = state_.panel;
  const Places at = places(with_panel, with_panel ? menu_bar(panel) : 0.0f);
  if (with_panel) side_panel(panel, at.panel);
  const PictureArea area = picture_window(panel, at.picture);
  if (with_panel) panel_edge(panel, at.panel, at.beside);
  status_window(panel, at.status);
  const ImVec2 corner(area.corner.x, area.corner.y);
  shader_errors_overlay(panel, corner);
  legend_overlay(panel, {corner.x + area.size.x, corner.y}, area.size.x);
  messages_overlay(panel, {corner.x, corner.y + area.size.y}, ImGui::GetTime());
  help_overlay(panel);
  closing_question(panel);
  state_.popup_open = ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
  note_edit();
  return area;
}

// The edge between panel and picture, which the mouse drags.
void Viewer::panel_edge(const Panel& panel, const Box& box, bool upright) {
  const float grip = 3 * window_.scale();
  const ImVec2 corner =
      upright ? ImVec2(box.corner.x + box.size.x - grip, box.corner.y) : ImVec2(box.corner.x, box.corner.y - grip);
  const ImVec2 size = upright ? ImVec2(2 * grip, box.size.y) : ImVec2(box.size.x, 2 * grip);
  ImGui::SetNextWindowPos(corner);
  ImGui::SetNextWindowSize(size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  // Windows that are never brought to the front lie behind those before them, and this one lies over both.
  constexpr ImGuiWindowFlags flags = (fixed_window & ~ImGuiWindowFlags_NoBringToFrontOnFocus) |
                                     ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoNav |
                                     ImGuiWindowFlags_NoFocusOnAppearing;
  ImGui::Begin("panel edge", nullptr, flags);
  ImGui::PopStyleVar(2);
  ImGui::InvisibleButton("edge", size);
  panel.widgets.mark("panel edge");
  if (ImGui::IsItemHovered() || ImGui::IsItemActive())
    ImGui::SetMouseCursor(upright ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
  if (ImGui::IsItemActive() && ImGui::IsMousePosValid()) {
    const ImVec2 pointer = ImGui::GetIO().MousePos;
    if (upright) {
      state_.panel_width = std::clamp(pointer.x / window_.scale(), enough_for_panel, most_panel_width);
    } else {
      const float end = box.corner.y + box.size.y, whole = box.size.y / state_.panel_share;
      state_.panel_share = std::clamp((end - pointer.y) / whole, least_panel_share, most_panel_share);
    }
  }
  ImGui::End();
}

void Viewer::status_window(const Panel& panel, const Box& box) {
  ImGui::SetNextWindowPos(box.corner);
  ImGui::SetNextWindowSize(box.size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {10 * window_.scale(), 2 * window_.scale()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
  ImGui::Begin("status", nullptr, fixed_window | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar(2);
  status_bar(panel);
  ImGui::End();
}

PictureArea Viewer::picture_window(const Panel& panel, const Box& box) {
  ImGui::SetNextWindowPos(box.corner);
  ImGui::SetNextWindowSize(box.size);
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("picture", nullptr, fixed_window | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
  ImGui::PopStyleVar();
  const ImVec2 dots = ImGui::GetIO().DisplayFramebufferScale;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  window_size_ = glm::max(glm::ivec2(room.x * dots.x, room.y * dots.y), 1);
  // What was presented last stays while a picture is drawn; else present() draws into this texture, after the
  // interface.
  if (a_.shown != nullptr && !attending_)
    presented_ = &device_.device.target("viewer/window", {.width = window_size_.x, .height = window_size_.y});
  const PictureArea area = picture_area(panel, presented_);
  ImGui::End();
  return area;
}

void Viewer::side_panel(const Panel& panel, const Box& box) {
  struct Tab {
    const char* name;
    void (*draw)(const Panel&);
  };
  static constexpr std::array tabs{Tab{"Shadow", shadow_panel},   Tab{"Scene", scene_panel},
                                   Tab{"Inspect", inspect_panel}, Tab{"Compare", compare_panel},
                                   Tab{"Cost", cost_panel},       Tab{"Files", files_panel}};
  ImGui::SetNextWindowPos(box.corner);
  ImGui::SetNextWindowSize(box.size);
  // It scrolls where a tab is higher than the panel, and where the whole window is narrower than a panel has to be.
  ImGuiWindowFlags flags = fixed_window & ~ImGuiWindowFlags_NoScrollbar;
  if (const float enough = enough_for_panel * window_.scale(); box.size.x < enough) {
    flags |= ImGuiWindowFlags_HorizontalScrollbar;
    ImGui::SetNextWindowContentSize({enough - 2 * ImGui::GetStyle().WindowPadding.x, 0});
  }
  if (ImGui::Begin("panel", nullptr, flags) && ImGui::BeginTabBar("tabs")) {
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
  ImGui::End();
}

// Chooses camera and sun as `render` would for the present options.
void Viewer::update_view() {
  if (scene_ == nullptr) return;
  cli::SceneOptions& options = state_.document.options;
  options.size = {window_size_.x, window_size_.y};
  std::string wanted = cli::command_text("", scene_arguments(options));
  if (wanted == view_options_) return;
  view_options_ = std::move(wanted);  // first: what can't be chosen is told once
  session::update_view(scene_->prepared, options);
}

}  // namespace penumbra::viewer

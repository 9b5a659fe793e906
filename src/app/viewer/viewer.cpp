#include "app/viewer/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <utility>

#include "app/receivers.h"
#include "app/techniques.h"
#include "io/presets.h"
#include "metrics/flip.h"
#include "studio/shader_reload.h"
#include "studio/text.h"

namespace penumbra::app {

namespace {

constexpr float panel_width = 390, least_picture = 240;

volatile std::sig_atomic_t caught_signal = 0;

void end_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int number) { caught_signal = number; };
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

gl::Timers::Mode timing(const gl::DeviceInfo& device) {
  return device.software ? gl::Timers::Mode::finish : gl::Timers::Mode::query;
}

// The first document: what the command line says.
Document document_of(const ViewOptions& options) {
  Document document;
  document.stage = options;
  document.stage.frames = studio::FrameRange{};
  document.params = studio::resolve_params(options, all_techniques());
  return document;
}

std::string number_text(const std::vector<float>& values) {
  std::string text;
  for (const float v : values) text += fmt::format("{}{:.4g}", text.empty() ? "" : "  ", v);
  return text;
}

}  // namespace

Viewer::Viewer(const ViewOptions& options)
    : options_(options),
      window_({.width = options.size.width, .height = options.size.height, .debug = options.debug}),
      device_info_(gl::device_info()),
      device_(gl::ShaderFiles(options.glsl), timing(device_info_)),
      truth_({.cache = options.folder(), .threads = options.threads.value_or(0), .background = true}),
      renderer_(device_, truth_.registry()),
      a_(device_, renderer_, 0),
      b_(device_, renderer_, 1),
      pace_(device_info_.software),
      facts_{.techniques = renderer_.registry(),
             .device = device_info_,
             .gl = device_,
             .costs_a = a_.costs,
             .costs_b = b_.costs} {
  state_.document = document_of(options);
  if (!options.glsl.empty()) watch_.add_folder(options.glsl);
}

Viewer::~Viewer() { truth_.stop(); }

int Viewer::run() {
  end_on_signals();
  open(options_.scene);
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
  return caught_signal == 0 ? 0 : 128 + caught_signal;
}

void Viewer::guarded(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
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
  draw_pictures(area, ImGui::GetTime());
  probe(area);
  show_pictures();
  window_.show();
  cost_reader_.read(device_.timers, ImGui::GetTime());
  if (!options_.layout.empty()) guarded([&] { widgets_.write_changes(options_.layout); });
  if (std::exchange(vsync_, state_.vsync) != state_.vsync) window_.set_vsync(state_.vsync);
}

void Viewer::take_events() {
  for (const std::string& path : window_.dropped()) {
    if (std::filesystem::path(path).extension() == ".toml") {
      state_.requests.open_preset = path;
    } else {
      state_.requests.open = path;
    }
  }
  take_loaded();
  take_shaders();
}

void Viewer::take_loaded() {
  guarded([&] {
    std::optional<SceneLoader::Loaded> loaded = loader_.finished();
    facts_.loading = loader_.file().empty() ? "" : std::filesystem::path(loader_.file()).filename().string();
    if (!loaded) return;
    truth_.stop();
    auto scene = std::make_unique<LoadedScene>(device_, std::move(loaded->stage));
    scene_ = std::move(scene);
    facts_.scene = scene_.get();
    const studio::Size size = state_.document.stage.size;
    state_.document.stage = loaded->options;
    state_.document.stage.size = size;
    state_.document.frame = 0;
    state_.scene_file = loaded->options.scene;
    std::erase(state_.recent, loaded->options.scene);
    state_.recent.insert(state_.recent.begin(), loaded->options.scene);
    for (Side* side : {&a_, &b_}) {
      side->painter.cut();
      side->costs.clear();
    }
    aimed_.clear();
    window_.set_title(std::filesystem::path(loaded->options.scene).filename().string() + " - Penumbra");
  });
}

void Viewer::take_shaders() {
  if (options_.glsl.empty()) return;
  guarded([&] {
    const std::vector<std::filesystem::path> changed = watch_.poll();
    if (changed.empty()) return;
    const studio::ShaderReload reload = studio::reload_shaders(device_.shaders, changed);
    facts_.shader_errors = reload.errors;
    if (!reload.redraws()) return;
    a_.painter.cut();
    b_.painter.cut();
    tell(state_,
         fmt::format("{} programs compiled in {:.2f} s; what techniques remember begins anew", reload.rebuilt,
                     reload.seconds),
         ImGui::GetTime());
  });
}

void Viewer::play(float seconds) {
  Playback& playback = state_.playback;
  if (!playback.playing || scene_ == nullptr) return;
  playback.carried += std::min(seconds, 0.25f) * playback.speed * state_.document.stage.fps;
  const double whole = std::floor(playback.carried);
  playback.carried -= whole;
  state_.document.frame += static_cast<int>(whole);
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
    const bool open = ImGui::BeginTabItem(tab.name);
    panel.widgets.mark(std::string("tab ") + tab.name);
    if (!open) continue;
    tab.draw(panel);
    ImGui::EndTabItem();
  }
  ImGui::EndTabBar();
}

// Camera and sun as `render` would choose them for these options.
void Viewer::aim() {
  if (scene_ == nullptr) return;
  studio::StageOptions& stage = state_.document.stage;
  stage.size = {window_size_.x, window_size_.y};
  std::string wanted = studio::command_text("", stage_arguments(stage));
  if (wanted == aimed_) return;
  studio::aim(scene_->stage, stage);
  aimed_ = std::move(wanted);
}

Document Viewer::document_b() const {
  Document document = state_.document;
  document.params = state_.comparison.params;
  return document;
}

void Viewer::draw_pictures(const PictureArea& area, double now) {
  if (scene_ == nullptr) return;
  const Document b = document_b();
  const bool both = state_.comparison.on && !b.params.rows().empty();
  const bool traced = facts_.tracing.has_value() && !truth_.pending();
  if (traced) b_.painter.cut();
  const bool same_a = a_.painter.shows(state_.document), same_b = !both || b_.painter.shows(b);
  const bool busy = ImGui::IsAnyItemActive() && !area.busy;
  const int wanted = std::max(warmup_of(state_.document) + 1, both ? warmup_of(b) + 1 : 1);
  const int frames = both ? std::min(a_.painter.frames(), b_.painter.frames()) : a_.painter.frames();
  const Pace::Step step = pace_.next(now, !same_a || !same_b, busy, frames, wanted);
  const std::string inspected =
      fmt::format("{} {} {}", state_.inspection.what, state_.inspection.layer, state_.inspection.level);
  const bool looks = std::exchange(inspected_, inspected) != inspected;
  if (!step.draw && !looks) return;
  const int divisor = step.draw ? step.divisor : 1;
  last_draw_ = now;
  facts_.distance.reset();
  double milliseconds = 0;
  // A comes last: what is read of the renderer is read of A.
  if (both && draw_side(b_, b, divisor)) milliseconds += b_.painter.milliseconds();
  facts_.tracing.reset();
  if (const auto pending = truth_.pending(); both && pending) facts_.tracing = pending->share_done;
  if (!draw_side(a_, state_.document, divisor)) return;
  milliseconds += a_.painter.milliseconds();
  pace_.drew(divisor, milliseconds);
  facts_.drawn_size = {a_.painter.picture().width(), a_.painter.picture().height()};
  facts_.frames = a_.painter.frames();
  if (both && divisor == 1 && frames + 1 >= wanted) measure_distance();
}

bool Viewer::draw_side(Side& side, const Document& document, int divisor) {
  bool drawn = false;
  guarded([&] {
    cost_reader_.start(device_.timers, side.costs);
    side.painter.draw(*scene_, document, divisor);
    inspect(side);
    if (state_.comparison.on && divisor == 1) side.visibility = renderer_.read_aov("shadow");
    drawn = true;
  });
  return drawn;
}

void Viewer::inspect(Side& side) {
  side.seen = &side.painter.picture();
  if (state_.inspection.what.empty()) return;
  side.values = read_values(state_.inspection, renderer_, device_);
}

// Over what faces the sun, and from what is shown at full size.
void Viewer::measure_distance() {
  const glm::ivec2 size = facts_.drawn_size;
  const metrics::Picture a{size.x, size.y, a_.visibility}, b{size.x, size.y, b_.visibility};
  if (a.pixels.size() != a.pixel_count() || b.pixels.size() != b.pixel_count()) return;
  const std::vector<std::uint8_t> receivers =
      receivers_of(renderer_, scene_->stage.setup.sun.to_light, state_.document.params.get_float("sun.angle"));
  facts_.distance =
      Distance{.figures = metrics::error_figures(a, b, receivers), .flip = metrics::flip(a, b, receivers).mean};
}

void Viewer::probe(const PictureArea& area) {
  std::optional<glm::ivec2> pixel;
  if (state_.probe && area.cursor && a_.seen != nullptr && facts_.drawn_size.x > 0)
    pixel = pixel_at(present_inputs(window_size_), *area.cursor * glm::vec2(window_size_) / area.size);
  facts_.probed = pixel;
  if (!pixel || (pixel == last_probed_ && last_draw_ < ImGui::GetTime())) return;
  last_probed_ = pixel;
  // Pictures in motion are smaller.
  const glm::ivec2 full(state_.document.stage.size.width, state_.document.stage.size.height);
  const glm::ivec2 drawn = glm::min(*pixel * facts_.drawn_size / full, facts_.drawn_size - 1);
  facts_.probe.clear();
  for (const render::Aov& aov : render::aovs())
    facts_.probe.push_back({aov.name, number_text(renderer_.read_aov(aov.name, drawn))});
}

void Viewer::show_pictures() {
  if (a_.seen == nullptr) return;
  if (!state_.inspection.what.empty()) {
    facts_.look = look_of(state_.inspection.what);
    facts_.range = range_of(state_.inspection, facts_.look, a_.values);
    color(a_, 0);
    if (state_.comparison.on && b_.seen != nullptr) color(b_, 1);
  } else {
    a_.seen = &a_.painter.picture();
    if (b_.painter.has_picture()) b_.seen = &b_.painter.picture();
  }
  present(device_, present_inputs(window_size_));
  gl::leave_initial_state();
}

void Viewer::color(Side& side, int number) {
  if (side.values.numbers.empty()) return;
  const std::vector<std::uint8_t> colors = colors_of(side.values, facts_.look, facts_.range);
  const gl::Texture& texture = device_.target(fmt::format("viewer/colors {}", number),
                                              {.width = side.values.width, .height = side.values.height});
  texture.upload(GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(colors)));
  side.seen = &texture;
}

PresentInputs Viewer::present_inputs(const glm::ivec2& window_size) const {
  const studio::Size size = state_.document.stage.size;
  return {.a = a_.seen,
          .b = state_.comparison.on ? b_.seen : nullptr,
          .picture_size = {size.width, size.height},
          .window_size = window_size,
          .comparison = state_.comparison,
          .zoom = state_.zoom};
}

}  // namespace penumbra::app

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/trigonometric.hpp>

#include "session/techniques.h"
#include "viewer/edit.h"
#include "viewer/fields.h"
#include "viewer/panels.h"

namespace penumbra::viewer {

namespace {

void file(const Panel& panel) {
  UiState& state = panel.state;
  begin_rows("file");
  row("file", "A .gltf or .glb file: type its name and press Enter, choose it from a list, or drop it on the window.");
  if (text_field(panel.widgets, "scene file", state.scene_file, "", ImGuiInputTextFlags_EnterReturnsTrue))
    state.requests.open = state.scene_file;
  row("recent", "Scenes that were opened before.");
  if (ImGui::BeginCombo("##recent", state.recent.empty() ? "none" : "…")) {
    for (const std::string& path : state.recent) {
      if (choice(path)) state.requests.open = path;
      panel.widgets.mark("recent=" + path);
    }
    ImGui::EndCombo();
  } else {
    panel.widgets.mark("recent");
  }
  end_rows();
  if (ImGui::Button("Open...")) state.files.wanted = true;
  panel.widgets.mark("open");
  tooltip("Choose a scene or a preset file from a list (Ctrl + O)");
  file_browser(panel);
}

void choose_camera(const Panel& panel) {
  cli::SceneOptions& options = panel.state.document.options;
  row("look through", "A camera of the file, the one that penumbra render chooses by default, or a free one.");
  const std::string current = options.eye ? "free" : options.camera ? *options.camera : "automatic";
  const bool open = begin_combo("##camera", current);
  panel.widgets.mark("camera");
  if (!open) return;
  const auto look_through = [&](std::optional<std::string> camera) {
    use_scene_camera(options);
    options.camera = std::move(camera);
  };
  if (ImGui::Selectable("automatic", !options.eye && !options.camera)) look_through({});
  panel.widgets.mark("camera=automatic");
  const std::vector<std::string>& cameras = panel.status.scene->cameras;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (choice(fmt::format("{}  {}", i, cameras[i]))) look_through(render::text_of_index(cameras, i));
    panel.widgets.mark(fmt::format("camera={}", i));
  }
  ImGui::EndCombo();
}

// With three decimals, of which a tiny negative number would be "-0.000".
bool place_field(WidgetMap& widgets, const char* name, glm::vec3& place) {
  glm::vec3 shown = place;
  for (int i = 0; i < 3; ++i) shown[i] = shown[i] > -0.0005f && shown[i] <= 0 ? 0 : shown[i];
  if (!type_vector(widgets, name, shown, 3)) return false;
  constexpr float farthest = 1e9f;  // of what --eye and --target take, metres
  place = glm::clamp(shown, -farthest, farthest);
  return true;
}

void camera(const Panel& panel) {
  UiState& state = panel.state;
  const session::PreparedScene& prepared = panel.status.scene->prepared;
  CameraRig rig = present_rig(state.document, prepared);
  begin_rows("camera");
  choose_camera(panel);
  bool moved = false;
  row("eye", "Where the camera is, metres.");
  moved |= place_field(panel.widgets, "eye", rig.eye);
  row("target", "What it looks at, metres.");
  moved |= place_field(panel.widgets, "target", rig.target);
  row("field of view", "Of the picture's height.");
  float degrees = glm::degrees(rig.fov_y);
  const bool wider = slider(panel.widgets, "fov", degrees, 5, 120, "%.1f°");
  tooltip_beside(panel.widgets, "Of the picture's height.");
  if (wider) {
    rig.fov_y = glm::radians(degrees);
    moved = true;
  }
  end_rows();
  if (moved && rig.eye != rig.target) place(state.document, prepared, rig);
  if (ImGui::Button("Frame casters")) state.requests.frame_casters = true;
  panel.widgets.mark("frame casters");
  tooltip("Shows all that casts shadows, without the ground (Home)");
  same_line_for("Copy camera");
  if (ImGui::Button("Copy camera")) state.requests.copy_camera = true;
  panel.widgets.mark("copy camera");
  tooltip("As arguments of penumbra render");
  same_line_for("Fly", /* has_box= */ true);
  ImGui::Checkbox("Fly", &state.fly);
  panel.widgets.mark("fly");
  tooltip("The left button looks around from the eye; W A S D Q E move (F)");
}

bool slider_row(WidgetMap& widgets, const char* name, const std::string& help, float& value, float low, float high,
                const char* format) {
  row(name, help);
  const bool changed = slider(widgets, name, value, low, high, format);
  tooltip_beside(widgets, help);
  return changed;
}

// Whether the user has turned the sun off. A scene without one gets one as soon as it is given a direction.
bool sun_is_off(const cli::SceneOptions& options, const session::PreparedScene& prepared) {
  if (options.no_sun) return true;
  const bool of_file = std::ranges::find(prepared.scene.lights, scene::LightKind::directional,
                                         &scene::PunctualLight::kind) != prepared.scene.lights.end();
  return !options.sun && of_file && !prepared.setup.sun_shines;
}

void sun(const Panel& panel) {
  UiState& state = panel.state;
  const cli::Direction sun = present_sun(state.document, panel.status.scene->prepared);
  float azimuth = glm::degrees(sun.azimuth), elevation = glm::degrees(sun.elevation);
  begin_rows("sun");
  const bool off = sun_is_off(state.document.options, panel.status.scene->prepared);
  ImGui::BeginDisabled(off);
  const std::string how = off ? "The sun is off: see the list of lights." : "The right mouse button drags the sun.";
  bool moved = slider_row(panel.widgets, "azimuth", "From +Z towards +X. " + how, azimuth, -180, 180, "%.1f°");
  moved |= slider_row(panel.widgets, "elevation", "Over the horizon. " + how, elevation, 0, 90, "%.1f°");
  ImGui::EndDisabled();
  std::string fault;
  ParamSet& params = state.document.params;
  param_row(params, session::unmodified(params), params.row("sun.angle"), panel.widgets, fault);
  end_rows();
  if (moved) {
    state.document.options.sun = cli::Direction{glm::radians(azimuth), glm::radians(elevation)};
    state.document.options.no_sun = false;
  }
}

double longest_animation(const scene::Scene& scene) {
  double longest = 0;
  for (const scene::Animation& animation : scene.animations)
    longest = std::max(longest, static_cast<double>(animation.duration));
  return longest;
}

void time(const Panel& panel) {
  UiState& state = panel.state;
  Document& document = state.document;
  const double duration = longest_animation(panel.status.scene->prepared.scene);
  if (duration <= 0) {
    ImGui::TextDisabled("The scene has no animation.");
    return;
  }
  if (ImGui::Button(state.playback.playing ? "Pause" : "Play ")) state.playback.playing = !state.playback.playing;
  panel.widgets.mark("play");
  ImGui::SameLine();
  if (ImGui::Button("◀")) document.step(-1);
  panel.widgets.mark("step back");
  ImGui::SameLine();
  if (ImGui::Button("▶")) document.step(1);
  panel.widgets.mark("step");
  ImGui::SameLine();
  ImGui::Text("%.3f s", document.seconds());
  begin_rows("time");
  row("frame", "Of the animation, counted at --fps frames a second.");
  const int last = static_cast<int>(std::clamp(std::ceil(duration * document.options.fps), 1.0, double{last_frame}));
  slider(panel.widgets, "frame", document.frame, 0, std::max(last, document.frame));
  row("speed", "Of the playback.");
  slider(panel.widgets, "speed", state.playback.speed, 0.05f, 4, "%.2f ×", ImGuiSliderFlags_Logarithmic);
  end_rows();
}

bool section(const char* title) { return ImGui::CollapsingHeader(title, ImGuiTreeNodeFlags_DefaultOpen); }

}  // namespace

void scene_panel(const Panel& panel) {
  file(panel);
  if (panel.status.scene == nullptr) return;
  if (ImGui::BeginChild("scene", {0, rest_of_panel()})) {
    if (section("Camera")) camera(panel);
    if (section("Sun")) sun(panel);
    if (section("Lights")) lights_panel(panel);
    if (section("Time")) time(panel);
  }
  ImGui::EndChild();
}

}  // namespace penumbra::viewer

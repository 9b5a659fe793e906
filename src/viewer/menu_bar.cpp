#include <fmt/format.h>
#include <imgui.h>

#include "viewer/edit.h"
#include "viewer/panels.h"

namespace penumbra::viewer {

bool menu_item(const Panel& panel, const char* name, const char* keys, bool possible) {
  const bool taken = ImGui::MenuItem(name, keys, /* selected= */ false, possible);
  panel.widgets.mark(std::string("menu=") + name);
  return taken;
}

bool begin_menu(const Panel& panel, const char* name) {
  const bool open = ImGui::BeginMenu(name);
  panel.widgets.mark(std::string("menu ") + name);
  return open;
}

namespace {

void file_menu(const Panel& panel) {
  UiState& state = panel.state;
  const bool shown = panel.status.scene != nullptr;
  if (menu_item(panel, "Open...", "Ctrl+O")) state.open_files();
  if (menu_item(panel, "Save", "Ctrl+S", shown)) state.requests.save = true;
  ImGui::Separator();
  if (menu_item(panel, "Write picture", "F12", shown)) state.requests.write_picture = true;
  if (menu_item(panel, "Copy command line", "Ctrl+C", shown)) state.requests.copy_command = true;
  ImGui::Separator();
  if (menu_item(panel, "Quit", "Ctrl+Q")) state.requests.quit = true;
}

void edit_menu(const Panel& panel) {
  UiState& state = panel.state;
  const bool shown = panel.status.scene != nullptr;
  if (menu_item(panel, "Undo", "Ctrl+Z", panel.status.can_undo)) state.requests.undo = true;
  if (menu_item(panel, "Redo", "Ctrl+Shift+Z", panel.status.can_redo)) state.requests.redo = true;
  ImGui::Separator();
  const cli::SceneOptions& view = state.document.options;
  const bool moved = shown && (view.camera || view.eye || view.fov);
  if (menu_item(panel, "Back to the scene's camera", "", moved)) use_scene_camera(state.document.options);
}

void scale_menu(const Panel& panel) {
  if (!begin_menu(panel, "Interface scale")) return;
  for (const int percent : {75, 100, 125, 150, 175, 200, 250, 300}) {
    const float scale = static_cast<float>(percent) / 100.0f;
    if (menu_item(panel, fmt::format("{} %", percent).c_str(), panel.state.scale == scale ? "now" : ""))
      panel.state.scale = scale;
  }
  ImGui::EndMenu();
}

void view_menu(const Panel& panel) {
  UiState& state = panel.state;
  if (menu_item(panel, "Hide panel and menus", "Tab")) state.panel = false;
  if (menu_item(panel, state.comparison.on ? "Stop comparing" : "Compare A with B", "C"))
    state.compare(!state.comparison.on);
  if (menu_item(panel, "Tint by cascade", "T", panel.status.scene != nullptr)) toggle_cascade_tint(state.inspection);
  if (menu_item(panel, "Fit to the view", "0", state.zoom != Zoom{})) state.zoom = {};
  scale_menu(panel);
  if (menu_item(panel, "Mouse and keys", "F1")) state.help = !state.help;
}

}  // namespace

float menu_bar(const Panel& panel) {
  if (!ImGui::BeginMainMenuBar()) return 0;
  struct Menu {
    const char* name;
    void (*draw)(const Panel&);
  };
  for (const Menu& menu :
       {Menu{"File", file_menu}, Menu{"Edit", edit_menu}, Menu{"Camera", camera_menu}, Menu{"View", view_menu}}) {
    if (!begin_menu(panel, menu.name)) continue;
    menu.draw(panel);
    ImGui::EndMenu();
  }
  const float height = ImGui::GetWindowHeight();
  ImGui::EndMainMenuBar();
  return height;
}

}  // namespace penumbra::viewer

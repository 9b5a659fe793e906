// Where the parts of the window are: menus, panel, picture and status line.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "viewer/viewer.h"

namespace penumbra::viewer {

namespace {

// Pixels at an interface scale of 1. A panel that is wider than `enough_for_panel` cuts nothing off.
constexpr float least_picture = 240, enough_for_panel = 380;
constexpr ImGuiWindowFlags fixed_window = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                          ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus;

}  // namespace

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
  no_scene_overlay(panel, {corner.x + area.size.x / 2, corner.y + area.size.y / 2}, area.size.x);
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
  // interface, where something has changed.
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

}  // namespace penumbra::viewer

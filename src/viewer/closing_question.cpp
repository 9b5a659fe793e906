#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <imgui.h>

#include <filesystem>
#include <string>
#include <utility>

#include "viewer/panels.h"

namespace penumbra::viewer {

namespace {

void list_changes(const ViewerStatus& status, bool closes_window) {
  ImGui::TextUnformatted("There are changes that are not saved:");
  ImGui::PushTextWrapPos(ImGui::GetFontSize() * 30.0f);
  if (status.unsaved.view) ImGui::BulletText("sun, lights, lamps or bookmarks, in %s", status.saved_to.c_str());
  if (status.unsaved.preset && closes_window) ImGui::BulletText("parameters, in the preset %s", status.preset.c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace

void closing_question(const Panel& panel) {
  UiState& state = panel.state;
  const bool closes_window = state.closing.scene.empty();
  const std::string scene = std::filesystem::path(state.closing.scene).filename().string();
  // ImGui tells popups apart by what follows "###".
  const std::string title = (closes_window ? "Close Penumbra" : "Open " + scene) + "###closing";
  if (std::exchange(state.closing.wanted, false)) ImGui::OpenPopup(title.c_str());
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x * 0.5f, size.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
  state.closing.asks = ImGui::BeginPopupModal(
      title.c_str(), nullptr,
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  if (!state.closing.asks) return;
  list_changes(panel.status, closes_window);
  ImGui::Spacing();
  const auto button = [&](const char* name) {
    const bool taken = ImGui::Button(name);
    if (taken) ImGui::CloseCurrentPopup();
    panel.widgets.mark(std::string("closing=") + name);
    return taken;
  };
  if (button("Save")) state.requests.closing = ClosingAnswer::save;
  ImGui::SetItemDefaultFocus();
  ImGui::SameLine();
  if (button("Discard")) state.requests.closing = ClosingAnswer::discard;
  ImGui::SameLine();
  if (button("Cancel") || ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, /* repeat= */ false)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace penumbra::viewer

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
  const auto item = [](const std::string& text) {
    ImGui::Bullet();
    ImGui::TextUnformatted(text.c_str());
  };
  ImGui::PushTextWrapPos(wrap_width(30.0f, ImGui::GetIO().DisplaySize.x));
  if (status.unsaved.changes()) ImGui::TextUnformatted("There are changes that are not saved:");
  if (status.unsaved.view) item("sun, lights, lamps or bookmarks, in " + status.saved_to);
  if (status.unsaved.preset && closes_window) item("parameters, in the preset " + status.preset);
  if (status.unsaved.picture && closes_window)
    ImGui::TextUnformatted("A picture is still being written. Closing the window ends that.");
  ImGui::PopTextWrapPos();
}

}  // namespace

void closing_question(const Panel& panel) {
  UiState& state = panel.state;
  const bool closes_window = state.closing.scene.empty();
  const std::string scene = std::filesystem::path(state.closing.scene).filename().string();
  // ImGui tells popups apart by what follows "###".
  const float room = wrap_width(16.0f, ImGui::GetIO().DisplaySize.x);  // as wide as the text below it
  const std::string title = shortened(closes_window ? "Close Penumbra" : "Open " + scene, room) + "###closing";
  if (std::exchange(state.closing.wanted, false)) ImGui::OpenPopup(title.c_str());
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x * 0.5f, size.y * 0.5f}, ImGuiCond_Always, {0.5f, 0.5f});
  state.closing.asks = ImGui::BeginPopupModal(
      title.c_str(), nullptr,
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  if (!state.closing.asks) return;
  // The picture has been written meanwhile.
  if (!panel.status.unsaved.any()) {
    state.requests.closing = ClosingAnswer::discard;
    ImGui::CloseCurrentPopup();
  }
  list_changes(panel.status, closes_window);
  ImGui::Spacing();
  const auto button = [&](const char* name) {
    const bool taken = ImGui::Button(name) || enter_on_item();
    if (taken) ImGui::CloseCurrentPopup();
    panel.widgets.mark(std::string("closing=") + name);
    return taken;
  };
  if (panel.status.unsaved.changes()) {
    if (button("Save")) state.requests.closing = ClosingAnswer::save;
    ImGui::SetItemDefaultFocus();
    ImGui::SameLine();
    if (button("Discard")) state.requests.closing = ClosingAnswer::discard;
  } else if (button("Close")) {
    state.requests.closing = ClosingAnswer::discard;
  }
  ImGui::SameLine();
  const bool cancels = button("Cancel");
  if (!panel.status.unsaved.changes()) ImGui::SetItemDefaultFocus();
  if (cancels || ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, /* repeat= */ false)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
}

}  // namespace penumbra::viewer

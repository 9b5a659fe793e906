#include <fmt/format.h>
#include <imgui.h>

#include "viewer/bookmarks.h"
#include "viewer/edit.h"
#include "viewer/panels.h"

namespace penumbra::viewer {

void store_bookmark(const Panel& panel, std::size_t index) {
  UiState& state = panel.state;
  if (panel.status.scene == nullptr) return;
  state.bookmarks.at(index) = bookmark_of(state.document, panel.status.scene->prepared);
  tell(state, fmt::format("bookmark {} stored; the key {} goes back to it", index + 1, index + 1), ImGui::GetTime());
}

void use_bookmark(const Panel& panel, std::size_t index) {
  UiState& state = panel.state;
  if (panel.status.scene == nullptr) return;
  if (const std::optional<Bookmark>& bookmark = state.bookmarks.at(index)) {
    go_to(state.document, panel.status.scene->prepared, *bookmark);
  } else {
    tell(state, fmt::format("bookmark {} is empty: Ctrl + {} stores the camera there", index + 1, index + 1),
         ImGui::GetTime());
  }
}

void camera_menu(const Panel& panel) {
  UiState& state = panel.state;
  const bool shown = panel.status.scene != nullptr;
  if (menu_item(panel, "Frame casters", "Home", shown)) state.requests.frame_casters = true;
  ImGui::Separator();
  for (std::size_t i = 0; i < state.bookmarks.size(); ++i) {
    if (menu_item(panel, fmt::format("Go to bookmark {}", i + 1).c_str(), fmt::format("{}", i + 1).c_str(),
                  shown && state.bookmarks[i]))
      use_bookmark(panel, i);
  }
  ImGui::Separator();
  if (!begin_menu(panel, "Store bookmark")) return;
  for (std::size_t i = 0; i < state.bookmarks.size(); ++i) {
    if (menu_item(panel, fmt::format("Bookmark {}", i + 1).c_str(), fmt::format("Ctrl+{}", i + 1).c_str(), shown))
      store_bookmark(panel, i);
  }
  ImGui::EndMenu();
}

}  // namespace penumbra::viewer

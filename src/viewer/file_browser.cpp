#include <imgui.h>

#include <algorithm>
#include <string>
#include <utility>

#include "viewer/panels.h"

namespace penumbra::viewer {

namespace {

constexpr const char* title = "open a file";
const std::string usual_note = "scenes (.gltf, .glb) and preset files (.toml)";

void open_folder(FileList& files, const std::filesystem::path& folder) {
  if (!folder.empty()) files = list_folder(folder);
}

// Returns the folder that was clicked on, if any. The caller lists it after this list is drawn.
std::filesystem::path list(const Panel& panel, const FileList& files) {
  std::filesystem::path wanted;
  const std::string& note = files.note.empty() ? usual_note : files.note;
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float below = ImGui::CalcTextSize(note.c_str(), nullptr, false, room.x).y + ImGui::GetStyle().ItemSpacing.y;
  ImGui::BeginChild("files", {0, std::max(room.y - below, 4 * ImGui::GetFrameHeightWithSpacing())}, /* border= */ true,
                    ImGuiWindowFlags_HorizontalScrollbar);
  for (const FileList::Entry& entry : files.entries) {
    const std::string label = entry.is_folder ? entry.name + "/" : entry.name;
    const bool chosen = choice(label, false, ImGuiSelectableFlags_DontClosePopups);
    panel.widgets.mark("open=" + label);
    if (!chosen) continue;
    const std::filesystem::path path = files.folder / entry.name;
    if (entry.is_folder) {
      wanted = path;
    } else {
      (is_preset(path) ? panel.state.requests.open_preset : panel.state.requests.open) = path.string();
      ImGui::CloseCurrentPopup();
    }
  }
  ImGui::EndChild();
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", note.c_str());
  ImGui::PopStyleColor();
  return wanted;
}

}  // namespace

void file_browser(const Panel& panel) {
  FileList& files = panel.state.files;
  if (std::exchange(files.wanted, false)) {
    open_folder(files, folder_of(panel.state.scene_file));
    ImGui::OpenPopup(title);
  }
  const ImVec2 whole = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({whole.x / 2, whole.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
  ImGui::SetNextWindowSize({std::max(whole.x * 0.6f, wrap_width(26.0f, whole.x)), whole.y * 0.7f});
  if (!ImGui::BeginPopup(title, ImGuiWindowFlags_NoMove)) return;
  const std::string folder = files.folder.string();
  const bool up = ImGui::Button("Up");
  panel.widgets.mark("open up");
  ImGui::SameLine();
  ImGui::TextWrapped("%s", folder.c_str());
  const std::filesystem::path wanted = list(panel, files);
  ImGui::EndPopup();
  open_folder(files, up ? files.folder.parent_path() : wanted);
}

}  // namespace penumbra::viewer

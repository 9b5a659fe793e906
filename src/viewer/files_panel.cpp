#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "viewer/fields.h"
#include "viewer/panels.h"

namespace penumbra::viewer {

void files_panel(const Panel& panel) {
  UiState& state = panel.state;
  begin_rows("picture");
  row("file", "A .png, or an .exr with all AOVs as layers. A sequence numbers its files.");
  text_field(panel.widgets, "picture file", state.picture_file);
  row("frames", "The first and the last frame of a sequence.");
  type_range(panel.widgets, "frames", state.sequence.first, state.sequence.last);
  end_rows();
  state.sequence.first = std::clamp(state.sequence.first, 0, last_frame);
  state.sequence.last = std::clamp(state.sequence.last, state.sequence.first, last_frame);
  ImGui::Checkbox("with every AOV", &state.with_aovs);
  panel.widgets.mark("with aovs");
  tooltip("As layers of an EXR, or as a PNG each");
  if (panel.status.writing) {
    progress(panel.widgets, "writing", static_cast<float>(*panel.status.writing), "writing");
    if (ImGui::Button("Stop")) state.requests.stop_writing = true;
    panel.widgets.mark("stop writing");
    tooltip("Ends the writing; files that are finished stay");
  } else {
    if (ImGui::Button("Write picture")) state.requests.write_picture = true;
    panel.widgets.mark("write picture");
    tooltip("Writes what penumbra render writes for the command line below (F12)");
    same_line_for("Write sequence");
    if (ImGui::Button("Write sequence")) state.requests.write_sequence = true;
    panel.widgets.mark("write sequence");
  }
  ImGui::Separator();
  if (ImGui::Button("Copy command line")) state.requests.copy_command = true;
  panel.widgets.mark("copy command");
  tooltip("The penumbra render command that draws this picture (Ctrl + C)");
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", panel.status.command.c_str());
  ImGui::PopTextWrapPos();
}

}  // namespace penumbra::viewer

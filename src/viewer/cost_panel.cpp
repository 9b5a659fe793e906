#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

#include "cli/text.h"
#include "viewer/fields.h"
#include "viewer/panels.h"

namespace penumbra::viewer {

namespace {

// "7 draws, 1 dispatch"
std::string commands_text(const gl::Timers::Work& work) {
  const auto counted = [](std::size_t count, const char* one, const char* many) {
    return fmt::format("{} {}", count, count == 1 ? one : many);
  };
  std::string text = work.draws > 0 ? counted(work.draws, "draw", "draws") : "";
  if (work.dispatches > 0) text += (text.empty() ? "" : ", ") + counted(work.dispatches, "dispatch", "dispatches");
  return text;
}

// "12.3 k"
std::string count_text(std::size_t count) {
  const auto number = static_cast<double>(count);
  if (number >= 1e6) return fmt::format("{:.2f} M", number / 1e6);
  return number >= 1e4 ? fmt::format("{:.1f} k", number / 1e3) : fmt::format("{}", count);
}

void bars(const Costs& costs, WidgetMap& widgets) {
  const double frame = costs.frame();
  ImGui::BeginTable("passes", 3, ImGuiTableFlags_SizingStretchProp);
  ImGui::TableSetupColumn("pass", ImGuiTableColumnFlags_WidthStretch, 0.34f);
  ImGui::TableSetupColumn("ms", ImGuiTableColumnFlags_WidthStretch, 0.38f);
  ImGui::TableSetupColumn("commands", ImGuiTableColumnFlags_WidthStretch, 0.28f);
  ImGui::PushTextWrapPos(0);
  for (const Costs::Pass& pass : costs.passes()) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(pass.name.c_str());
    ImGui::TableNextColumn();
    const auto share = static_cast<float>(frame > 0 ? pass.median / frame : 0);
    progress(widgets, "cost of " + pass.name, share, fmt::format("{:.2f} ms", pass.median));
    ImGui::TableNextColumn();
    const gl::Timers::Work work = costs.work(pass.name);
    ImGui::TextDisabled("%s", commands_text(work).c_str());
    if (work.triangles > 0) tooltip(count_text(work.triangles) + " triangles");
  }
  ImGui::PopTextWrapPos();
  ImGui::EndTable();
  const gl::Timers::Work all = costs.work("frame");
  ImGui::TextWrapped("frame %.2f ms (median of the last second)", frame);
  ImGui::TextWrapped("%s, %s triangles", commands_text(all).c_str(), count_text(all.triangles).c_str());
}

void plot(const Costs& costs) {
  const std::vector<float>& history = costs.history();
  if (history.empty()) return;
  const float most = *std::max_element(history.begin(), history.end());
  ImGui::PlotHistogram("##history", history.data(), static_cast<int>(history.size()), 0, nullptr, 0, most * 1.1f,
                       {ImGui::GetContentRegionAvail().x, 4 * ImGui::GetTextLineHeightWithSpacing()});
  ImGui::TextDisabled("frames, 0 to %.1f ms", static_cast<double>(most));
}

void memory(const Panel& panel) {
  begin_rows("memory");
  const auto amount = [&](const char* name, std::size_t bytes, const char* help) {
    row(name, help);
    ImGui::TextUnformatted(cli::bytes_text(static_cast<double>(bytes)).c_str());
  };
  amount("shadow targets", panel.status.gl.target_bytes("shadow "),
         "Shadow maps, masks and histories of all pictures.");
  amount("all targets", panel.status.gl.target_bytes(), "All textures that passes draw to.");
  end_rows();
}

void machine(const Panel& panel) {
  const gl::DeviceInfo& device = panel.status.device;
  ImGui::TextWrapped("%s", device.renderer.c_str());
  if (device.software)
    ImGui::TextWrapped(
        "A software rasteriser: the CPU draws, and times are those of the CPU. While the view moves, maps and taps are "
        "reduced, and then the picture's size; while a parameter changes, its size.");
}

void costs(const Panel& panel) {
  UiState& state = panel.state;
  machine(panel);
  ImGui::Checkbox("Wait for the screen (vsync)", &state.vsync);
  panel.widgets.mark("vsync");
  const bool both = state.comparison.on;
  if (ImGui::CollapsingHeader(both ? "Picture A" : "Passes", ImGuiTreeNodeFlags_DefaultOpen)) {
    bars(panel.status.costs_a, panel.widgets);
    plot(panel.status.costs_a);
  }
  if (both && ImGui::CollapsingHeader("Picture B", ImGuiTreeNodeFlags_DefaultOpen)) {
    ImGui::PushID("b");
    bars(panel.status.costs_b, panel.widgets);
    ImGui::PopID();
  }
  if (ImGui::CollapsingHeader("Memory", ImGuiTreeNodeFlags_DefaultOpen)) memory(panel);
}

}  // namespace

void cost_panel(const Panel& panel) {
  if (ImGui::BeginChild("cost", {0, rest_of_panel()})) costs(panel);
  ImGui::EndChild();
}

}  // namespace penumbra::viewer

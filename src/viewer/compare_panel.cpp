#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>

#include "session/techniques.h"
#include "truth/reference.h"
#include "viewer/fields.h"
#include "viewer/panels.h"

namespace penumbra::viewer {

namespace {

struct Way {
  CompareMode how;
  const char* name;
  const char* help;
};
constexpr std::array ways{
    Way{CompareMode::wipe, "wipe", "A to the left of a line, B to the right; drag the line."},
    Way{CompareMode::side_by_side, "side by side", "The same part of both, next to each other."},
    Way{CompareMode::a, "A", "A alone. The key X switches to B and back."},
    Way{CompareMode::b, "B", "B alone. The key X switches to A and back."},
    Way{CompareMode::difference, "difference", "|A - B| times the gain."},
};

void choose_b(const Panel& panel) {
  Comparison& comparison = panel.state.comparison;
  const shadow::Registry& registry = panel.status.techniques;
  const std::string current = session::selection_of(comparison.params).name;
  row("B is",
      "The technique of picture B. Choosing one copies A's values; after that only sun, casters, exposure and render "
      "options follow A. Truth and brute force are drawn without history and filters.");
  const bool open = begin_combo("##b", session::technique_label(comparison.params), ImGuiComboFlags_HeightLargest);
  panel.widgets.mark("b");
  if (!open) return;
  const auto item = [&](const std::string& name, const std::string& summary) {
    if (ImGui::Selectable(name.c_str(), name == current)) {
      comparison.params = panel.state.document.params;
      session::choose_technique(comparison.params, registry, name);
      if (truth::is_reference(name)) truth::make_reference(comparison.params);
    }
    panel.widgets.mark("b=" + name);
    tooltip(summary);
  };
  for (const shadow::Technique& technique : registry.techniques()) item(technique.name, technique.summary);
  ImGui::Separator();
  for (const shadow::Preset& preset : registry.presets()) item(preset.name, preset.summary);
  ImGui::EndCombo();
}

void choose_way(const Panel& panel) {
  Comparison& comparison = panel.state.comparison;
  row("shown", "How the two pictures share the window.");
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (i % 2 != 0) ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.5f);
    if (ImGui::RadioButton(ways.at(i).name, comparison.how == ways.at(i).how)) comparison.how = ways.at(i).how;
    panel.widgets.mark(std::string("compare=") + ways.at(i).name);
    tooltip(ways.at(i).help);
  }
  if (comparison.how != CompareMode::difference) return;
  row("gain", "What a difference is multiplied by.");
  slider(panel.widgets, "gain", comparison.gain, 1, 64, "%.0f ×", ImGuiSliderFlags_Logarithmic);
  tooltip_beside(panel.widgets, "What a difference is multiplied by.");
}

void figure(const char* name, const std::string& value, const char* help) {
  row(name, help);
  ImGui::TextUnformatted(value.c_str());
}

std::string decibels(double value) {
  if (std::isnan(value)) return "no penumbra";
  return std::isinf(value) ? "equal" : fmt::format("{:.2f} dB", value);
}

void difference(const Panel& panel) {
  if (panel.status.both_traced) {
    ImGui::TextWrapped("A and B are both ray traced, and only one can be: choose another technique for one of them.");
    return;
  }
  if (panel.status.tracing) {
    progress(panel.widgets, "tracing", static_cast<float>(*panel.status.tracing),
             fmt::format("tracing, {:.0f} %", *panel.status.tracing * 100));
    return;
  }
  if (!panel.status.difference) {
    ImGui::TextDisabled("Figures appear here once both pictures are finished.");
    return;
  }
  const metrics::ErrorFigures& figures = panel.status.difference->figures;
  begin_rows("distance");
  figure("PSNR", decibels(figures.psnr), "Of visibility, over all surfaces; B is the reference.");
  figure("PSNR penumbra", decibels(figures.psnr_penumbra),
         "The same over penumbrae: where B is between 0.02 and 0.98.");
  figure("RMSE", fmt::format("{:.5f}", figures.rmse), "Root mean square error of visibility.");
  figure("bias", fmt::format("{:+.5f}", figures.bias), "Mean error: above 0 where A is too bright.");
  figure("largest", fmt::format("{:.4f}", figures.max), "The greatest error of a pixel.");
  figure("FLIP", fmt::format("{:.5f}", panel.status.difference->flip), "How different the two look, 0 to 1.");
  if (figures.not_finite > 0)
    figure("not finite", fmt::format("{} values", figures.not_finite), "Of A; each counts as an error of 1.");
  end_rows();
  panel.widgets.mark("distance");
}

}  // namespace

void compare_panel(const Panel& panel) {
  UiState& state = panel.state;
  bool on = state.comparison.on;
  if (ImGui::Checkbox("Compare A with B", &on)) state.compare(on);
  panel.widgets.mark("compare");
  if (!state.comparison.on) {
    ImGui::TextWrapped(
        "Picture B can have another technique and other values, or be brute force or the ray-traced truth.");
    return;
  }
  begin_rows("b");
  choose_b(panel);
  choose_way(panel);
  end_rows();
  if (ImGui::Button("Copy A to B")) state.comparison.params = state.document.params;
  panel.widgets.mark("b takes a");
  same_line_for("Swap A and B");
  if (ImGui::Button("Swap A and B")) std::swap(state.comparison.params, state.document.params);
  panel.widgets.mark("swap");
  ImGui::Separator();
  difference(panel);
}

}  // namespace penumbra::viewer

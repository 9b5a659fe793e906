#include <fmt/format.h>
#include <imgui.h>

#include <array>
#include <cmath>

#include "truth/reference.h"
#include "viewer/panels.h"

namespace penumbra::viewer {

namespace {

struct Way {
  Comparing how;
  const char* name;
  const char* help;
};
constexpr std::array ways{
    Way{Comparing::wipe, "wipe", "A to the left of a line, B to the right; drag the line."},
    Way{Comparing::side_by_side, "side by side", "The same part of both, next to each other."},
    Way{Comparing::a, "A", "A alone (X goes to B and back)."},
    Way{Comparing::b, "B", "B alone (X goes to A and back)."},
    Way{Comparing::difference, "difference", "|A - B| times the gain."},
};

void choose_b(const Panel& panel) {
  Comparison& comparison = panel.state.comparison;
  const shadow::Registry& registry = panel.facts.techniques;
  const std::string current = comparison.params.get_word("technique");
  row("B is",
      "Its technique; sun, exposure and surroundings are A's, all else was when B was made. The truth and brute force "
      "have neither history nor filters.");
  const bool open = ImGui::BeginCombo("##b", current.c_str(), ImGuiComboFlags_HeightLarge);
  panel.widgets.mark("b");
  if (!open) return;
  for (const std::string& name : registry.names()) {
    if (ImGui::Selectable(name.c_str(), name == current)) {
      comparison.params = panel.state.document.params;
      registry.select(comparison.params, name);
      if (truth::is_reference(name)) truth::make_reference(comparison.params);
    }
    panel.widgets.mark("b=" + name);
  }
  ImGui::EndCombo();
}

void choose_way(const Panel& panel) {
  Comparison& comparison = panel.state.comparison;
  row("shown", "How the two share the window.");
  for (std::size_t i = 0; i < ways.size(); ++i) {
    if (i % 2 != 0) ImGui::SameLine(ImGui::GetContentRegionAvail().x * 0.5f);
    if (ImGui::RadioButton(ways.at(i).name, comparison.how == ways.at(i).how)) comparison.how = ways.at(i).how;
    panel.widgets.mark(std::string("compare=") + ways.at(i).name);
    tooltip(ways.at(i).help);
  }
  if (comparison.how != Comparing::difference) return;
  row("gain", "What a difference is multiplied by.");
  ImGui::SliderFloat("##gain", &comparison.gain, 1, 64, "%.0f ×",
                     ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  panel.widgets.mark("gain");
}

void figure(const char* name, const std::string& value, const char* help) {
  row(name, help);
  ImGui::TextUnformatted(value.c_str());
}

std::string decibels(double value) {
  if (std::isnan(value)) return "no penumbra";
  return std::isinf(value) ? "equal" : fmt::format("{:.2f} dB", value);
}

void distance(const Panel& panel) {
  if (panel.facts.both_traced) {
    ImGui::TextWrapped("A is traced too, and only one can be: choose another technique for A or B.");
    return;
  }
  if (panel.facts.tracing) {
    ImGui::ProgressBar(static_cast<float>(*panel.facts.tracing), {-1, 0},
                       fmt::format("tracing, {:.0f} %", *panel.facts.tracing * 100).c_str());
    return;
  }
  if (!panel.facts.distance) {
    ImGui::TextDisabled("Figures stand here once both pictures are at rest.");
    return;
  }
  const metrics::ErrorFigures& figures = panel.facts.distance->figures;
  begin_rows("distance");
  figure("PSNR", decibels(figures.psnr), "Of visibility, over all surfaces, B the reference.");
  figure("PSNR penumbra", decibels(figures.psnr_penumbra), "The same where B is between 0.02 and 0.98.");
  figure("RMSE", fmt::format("{:.5f}", figures.rmse), "Root mean square error of visibility.");
  figure("bias", fmt::format("{:+.5f}", figures.bias), "Mean error: above 0 where A is too bright.");
  figure("largest", fmt::format("{:.4f}", figures.max), "The greatest error of a pixel.");
  figure("FLIP", fmt::format("{:.5f}", panel.facts.distance->flip), "How different the two look, 0 to 1.");
  end_rows();
  panel.widgets.mark("distance");
}

}  // namespace

void compare_panel(const Panel& panel) {
  State& state = panel.state;
  bool on = state.comparison.on;
  if (ImGui::Checkbox("Compare A with B", &on)) state.compare(on);
  panel.widgets.mark("compare");
  if (!state.comparison.on) {
    ImGui::TextWrapped(
        "B is a picture of its own: another technique, other values, brute force or the ray-traced truth.");
    return;
  }
  begin_rows("b");
  choose_b(panel);
  choose_way(panel);
  end_rows();
  if (ImGui::Button("B takes A's values")) state.comparison.params = state.document.params;
  panel.widgets.mark("b takes a");
  ImGui::SameLine();
  if (ImGui::Button("Swap A and B")) std::swap(state.comparison.params, state.document.params);
  panel.widgets.mark("swap");
  ImGui::Separator();
  distance(panel);
}

}  // namespace penumbra::viewer

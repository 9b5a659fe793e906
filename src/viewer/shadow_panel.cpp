#include <imgui.h>

#include <algorithm>
#include <utility>

#include "core/names.h"
#include "session/techniques.h"
#include "shadow/selection.h"
#include "viewer/fields.h"
#include "viewer/panels.h"

namespace penumbra::viewer {

namespace {

bool is_technique(const shadow::Registry& registry, const std::string& group) {
  const auto techniques = registry.techniques();
  return std::any_of(techniques.begin(), techniques.end(), [&](const auto& each) { return each.name == group; });
}

// Whether each word of a search is in the parameter's name or help.
bool found(const Param& param, const std::string& search) {
  const std::string text = lower_case(param.name + " " + param.help), words = lower_case(search);
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    if (text.find(words.substr(begin, end - begin)) == std::string::npos) return false;
    begin = end + 1;
  }
  return true;
}

void choose_technique(const Panel& panel, ParamSet& params) {
  const shadow::Registry& registry = panel.status.techniques;
  const std::string current = session::selection_of(params).name;
  const auto item = [&](const std::string& name, const std::string& summary) {
    if (ImGui::Selectable(name.c_str(), name == current)) session::choose_technique(params, registry, name);
    panel.widgets.mark("technique=" + name);
    tooltip(summary);
  };
  row(panel.state.comparison.on ? "technique of A" : "technique",
      panel.state.comparison.on ? "How the shadows of picture A are computed. This tab edits A."
                                : "How shadows are computed.");
  const bool open = begin_combo("##technique", session::technique_label(params), ImGuiComboFlags_HeightLargest);
  panel.widgets.mark("technique");
  if (!open) return;
  for (const shadow::Technique& technique : registry.techniques()) item(technique.name, technique.summary);
  ImGui::Separator();
  for (const shadow::Preset& preset : registry.presets()) item(preset.name, preset.summary);
  ImGui::EndCombo();
}

// Whether a value of the group differs from what the technique or preset sets, or else from its default.
bool is_changed(const ParamSet& params, const ParamSet& base, const std::string& group) {
  return std::ranges::any_of(params.rows(), [&](const Param& param) {
    return shadow::group_of(param.name) == group && params.value(param.name) != base.value(param.name);
  });
}

// Returns whether there is a row to show. `base`: session::unmodified().
bool group(const Panel& panel, ParamSet& params, const ParamSet& base, const std::string& name, std::string& fault) {
  const auto shown = [&](const Param& param) {
    return shadow::group_of(param.name) == name && param.name != "technique" && found(param, panel.state.search);
  };
  const auto rows = params.rows();
  if (std::none_of(rows.begin(), rows.end(), shown)) return false;
  const bool own = is_technique(panel.status.techniques, name);
  const bool unused = own && name != params.get_word("technique");
  const bool searched = !panel.state.search.empty();
  if (unused && !searched) return false;
  const std::string title = name.empty() ? "general" : name;
  const bool first = own || name.empty() || name == "sun";
  const bool changed = is_changed(params, base, name);
  // Open while it is searched. It has another id then, so that it is as it was once the search is cleared.
  ImGui::SetNextItemOpen(searched || first, searched ? ImGuiCond_Always : ImGuiCond_Once);
  const std::string shown_title = title + (changed ? " *" : "") + (unused ? " (not in use)" : "");
  const bool open = ImGui::CollapsingHeader((shown_title + "###" + title + (searched ? " searched" : "")).c_str());
  panel.widgets.mark("group " + title);
  if (changed) tooltip("Has values that differ from those of \"" + session::selection_of(params).name + "\".");
  if (!open) return true;
  begin_rows(title.c_str());
  // A widget may change values, but not the list of declarations.
  for (const Param& param : rows) {
    if (shown(param)) param_row(params, base, param, panel.widgets, fault);
  }
  end_rows();
  return true;
}

std::vector<std::string> groups_of(const ParamSet& params) {
  std::vector<std::string> names;
  for (const Param& param : params.rows()) {
    const std::string name = shadow::group_of(param.name);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  // The technique's own group comes first.
  std::stable_partition(names.begin(), names.end(),
                        [&](const std::string& name) { return name == params.get_word("technique"); });
  return names;
}

void groups(const Panel& panel, ParamSet& params, std::string& fault) {
  bool any = false;
  const ParamSet base = session::unmodified(params);
  for (const std::string& name : groups_of(params)) any = group(panel, params, base, name, fault) || any;
  if (any) return;
  ImGui::TextWrapped("No parameter has these words in its name or help.");
  panel.widgets.mark("nothing found");
}

void ask_to_overwrite(const Panel& panel) {
  constexpr const char* title = "overwrite a preset";
  UiState& state = panel.state;
  if (std::exchange(state.overwrite.wanted, false)) ImGui::OpenPopup(title);
  if (!ImGui::BeginPopup(title)) return;
  ImGui::PushTextWrapPos(wrap_width(30.0f, ImGui::GetIO().DisplaySize.x));
  ImGui::Text("%s is there already.", state.overwrite.file.c_str());
  ImGui::PopTextWrapPos();
  if (ImGui::Button("Overwrite")) {
    state.requests.overwrite_preset = state.overwrite.file;
    ImGui::CloseCurrentPopup();
  }
  panel.widgets.mark("overwrite preset");
  ImGui::SameLine();
  if (ImGui::Button("Cancel")) ImGui::CloseCurrentPopup();
  panel.widgets.mark("keep preset");
  ImGui::EndPopup();
}

void presets(const Panel& panel) {
  UiState& state = panel.state;
  ImGui::SetNextItemWidth(-1);
  text_field(panel.widgets, "preset file", state.preset_file, "preset.toml");
  if (ImGui::Button("Load preset")) state.requests.open_preset = state.preset_file;
  panel.widgets.mark("load preset");
  same_line_for("Save preset");
  if (ImGui::Button("Save preset")) state.requests.save_preset = state.preset_file;
  panel.widgets.mark("save preset");
  ask_to_overwrite(panel);
}

}  // namespace

void shadow_panel(const Panel& panel) {
  UiState& state = panel.state;
  ParamSet& params = state.document.params;
  begin_rows("technique");
  choose_technique(panel, params);
  end_rows();
  ImGui::SetNextItemWidth(-ImGui::CalcTextSize("Reset all").x - 4 * ImGui::GetStyle().FramePadding.x);
  if (std::exchange(state.focus_search, false)) ImGui::SetKeyboardFocusHere();
  text_field(panel.widgets, "search", state.search, "Search parameters");
  ImGui::SameLine();
  if (ImGui::Button("Reset all")) params = session::unmodified(params);
  panel.widgets.mark("reset all");
  tooltip("Every parameter gets the value that \"" + session::selection_of(params).name +
          "\" sets, or else its default.");
  const float footer = 2 * ImGui::GetFrameHeightWithSpacing() + 2 * ImGui::GetStyle().ItemSpacing.y;
  std::string fault;
  if (ImGui::BeginChild("parameters", {0, rest_of_panel(footer)})) groups(panel, params, fault);
  ImGui::EndChild();
  if (!fault.empty()) tell_error(state, fault, ImGui::GetTime());
  ImGui::Separator();
  presets(panel);
}

}  // namespace penumbra::viewer

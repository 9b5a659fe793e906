#include "viewer/widgets.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "cli/options.h"
#include "io/output_file.h"
#include "io/report.h"
#include "viewer/fields.h"

namespace penumbra::viewer {

namespace {

std::string short_name(const std::string& name) {
  const std::size_t dot = name.find('.');
  std::string text = dot == std::string::npos ? name : name.substr(dot + 1);
  for (char& c : text) {
    if (c == '_') c = ' ';
  }
  return text;
}

std::string tooltip_of(const Param& param) {
  std::string text = fmt::format("{}\n\n{}\ndefault {}", param.help, param.name, to_text(param.default_value));
  const bool number =
      std::holds_alternative<int>(param.default_value) || std::holds_alternative<float>(param.default_value);
  if (number) text += fmt::format(", {:g} to {:g} {}", param.min, param.max, param.unit);
  return text;
}

// A range over several powers of ten gets a logarithmic slider, which has the same room for each power. So does one
// whose default would lie at its very beginning.
bool is_wide(const Param& param) {
  constexpr double beginning = 0.05;
  if (param.min < 0) return false;
  if (param.max >= 100 * std::max(param.min, 1.0)) return true;
  const auto* usual = std::get_if<float>(&param.default_value);
  return usual != nullptr && *usual > param.min && *usual - param.min < beginning * (param.max - param.min);
}

std::string unit_after(const Param& param) {
  if (param.unit.empty()) return "";
  return param.unit == "deg" ? "°" : " " + param.unit;
}

ImGuiSliderFlags flags_of(const Param& param) { return is_wide(param) ? ImGuiSliderFlags_Logarithmic : 0; }

bool choose_word(const Param& param, std::string& word, WidgetMap& widgets) {
  bool changed = false;
  const bool open = begin_combo("##value", word);
  widgets.mark(param.name);
  if (!open) return false;
  for (const std::string& choice : param.choices) {
    if (ImGui::Selectable(choice.c_str(), choice == word)) {
      word = choice;
      changed = true;
    }
    widgets.mark(param.name + "=" + choice);
  }
  ImGui::EndCombo();
  return changed;
}

// The widget of a value. Returns whether the user changed it.
bool edit(const Param& param, ParamValue& value, WidgetMap& widgets) {
  if (bool* on = std::get_if<bool>(&value)) {
    const bool changed = ImGui::Checkbox("##value", on);
    widgets.mark(param.name);
    return changed;
  }
  if (int* count = std::get_if<int>(&value)) {
    const std::string format = "%d" + unit_after(param);
    // Sliders end at half of what an int holds.
    const int most = static_cast<int>(std::min(param.max, 1073741822.0));
    return slider(widgets, param.name, *count, static_cast<int>(param.min), most, format.c_str(), flags_of(param));
  }
  if (float* quantity = std::get_if<float>(&value)) {
    const std::string format = "%.3g" + unit_after(param);
    return slider(widgets, param.name, *quantity, static_cast<float>(param.min), static_cast<float>(param.max),
                  format.c_str(), flags_of(param) | ImGuiSliderFlags_NoRoundToFormat);
  }
  return choose_word(param, std::get<std::string>(value), widgets);
}

}  // namespace

void WidgetMap::begin() { last_ = std::exchange(boxes_, {}); }

void WidgetMap::mark(std::string_view name) { mark(name, ImGui::GetItemRectMin(), ImGui::GetItemRectMax()); }

void WidgetMap::mark(std::string_view name, const ImVec2& low, const ImVec2& high) {
  boxes_.insert_or_assign(std::string(name), Box{static_cast<int>(low.x), static_cast<int>(low.y),
                                                 static_cast<int>(high.x), static_cast<int>(high.y)});
}

void WidgetMap::write_changes(const std::filesystem::path& file) {
  // ImGui needs a frame to compute the size of a popup, so rectangles are written once they are the same in two frames.
  // The end of "idle" is written at once, so that a script does not take an old picture for the finished one.
  const bool idle_ends = written_.contains(idle) && !boxes_.contains(idle);
  if (!idle_ends && (boxes_ != last_ || boxes_ == written_)) return;
  io::Json json = io::Json::object();
  for (const auto& [name, box] : boxes_) json[name] = {box.left, box.top, box.right, box.bottom};
  io::write_text(file, io::text_of(json));
  written_ = boxes_;
}

float rest_of_panel(float below) {
  return std::max(ImGui::GetContentRegionAvail().y - below, 4 * ImGui::GetFrameHeightWithSpacing());
}

void begin_rows(const char* id) {
  ImGui::BeginTable(id, 2, ImGuiTableFlags_SizingStretchProp);
  ImGui::TableSetupColumn("label", ImGuiTableColumnFlags_WidthStretch, 0.42f);
  ImGui::TableSetupColumn("widget", ImGuiTableColumnFlags_WidthStretch, 0.58f);
}

void row(const std::string& label, const std::string& text, bool changed) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGui::PushTextWrapPos(0);
  if (changed) {
    ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_CheckMark), "%s", label.c_str());
  } else {
    ImGui::TextUnformatted(label.c_str());
  }
  ImGui::PopTextWrapPos();
  if (!text.empty()) tooltip(text);
  ImGui::TableNextColumn();
  ImGui::SetNextItemWidth(-1);
}

void end_rows() { ImGui::EndTable(); }

bool param_row(ParamSet& params, const ParamSet& base, const Param& param, WidgetMap& widgets, std::string& fault) {
  ImGui::PushID(param.name.c_str());
  const ParamValue& usual = base.value(param.name);
  const bool differs = params.value(param.name) != usual;
  row(short_name(param.name), tooltip_of(param), differs);
  const float reset_width = ImGui::GetFrameHeight();
  if (differs) ImGui::SetNextItemWidth(-reset_width - ImGui::GetStyle().ItemInnerSpacing.x);
  ParamValue value = params.value(param.name);
  bool changed = edit(param, value, widgets);
  tooltip_beside(widgets, tooltip_of(param));
  if (differs) {
    ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
    if (ImGui::Button("×", {reset_width, 0})) {
      value = usual;
      changed = true;
    }
    widgets.mark(param.name + " reset");
    tooltip("Back to " + to_text(usual));
  }
  ImGui::PopID();
  if (!changed) return false;
  try {
    ParamSet wanted = params;
    cli::assign(wanted, param.name + "=" + to_text(value));
    params = std::move(wanted);
    return true;
  } catch (const Error& error) {
    fault = error.what();
    return false;
  }
}

bool choice(const std::string& text, bool chosen, ImGuiSelectableFlags flags) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushID(text.c_str());
  const std::string shown = shortened(text, wrap_width(1000.0f, ImGui::GetIO().DisplaySize.x));
  const float width = std::max(ImGui::CalcTextSize(shown.c_str()).x, ImGui::GetContentRegionAvail().x);
  const bool taken = ImGui::Selectable("##choice", chosen, flags, {width, 0});
  ImGui::PopID();
  ImGui::GetWindowDrawList()->AddText(at, ImGui::GetColorU32(ImGuiCol_Text), shown.c_str());
  if (shown != text) tooltip(text);
  return taken;
}

bool enter_on_item() {
  const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, /* repeat= */ false); };
  return ImGui::IsItemFocused() && (pressed(GLFW_KEY_ENTER) || pressed(GLFW_KEY_KP_ENTER));
}

void show_tooltip(const std::string& text) {
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(wrap_width(26.0f, ImGui::GetIO().DisplaySize.x));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void tooltip_beside(WidgetMap& widgets, const std::string& text) {
  if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsItemActive()) return;
  const ImGuiStyle& style = ImGui::GetStyle();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax(), window = ImGui::GetIO().DisplaySize;
  const ImVec2 inner =
      ImGui::CalcTextSize(text.c_str(), nullptr, false, wrap_width(26.0f, window.x) - style.WindowPadding.x);
  const float gap = style.ItemSpacing.y, width = inner.x + 2 * style.WindowPadding.x;
  const bool fits_below = high.y + gap + inner.y + 2 * style.WindowPadding.y <= window.y;
  ImGui::SetNextWindowPos({std::max(std::min(low.x, window.x - width), 0.0f), fits_below ? high.y + gap : low.y - gap},
                          ImGuiCond_Always, {0, fits_below ? 0.0f : 1.0f});
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(wrap_width(26.0f, window.x));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  widgets.mark("tooltip", at, {at.x + size.x, at.y + size.y});
  ImGui::EndTooltip();
}

void tooltip(const std::string& text) {
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) show_tooltip(text);
}

float wrap_width(float most, float room) {
  const float gaps = 4 * ImGui::GetStyle().WindowPadding.x;
  return std::clamp(room - gaps, 1.0f, ImGui::GetFontSize() * most);
}

std::string shortened(const std::string& text, float room) {
  if (ImGui::CalcTextSize(text.c_str()).x <= room) return text;
  const auto continues = [&](std::size_t at) { return at < text.size() && (text[at] & 0xC0) == 0x80; };  // UTF-8
  std::string shown;
  for (std::size_t end = 1; end < text.size(); ++end) {
    if (continues(end)) continue;
    const std::string longer = text.substr(0, end) + "…";
    if (ImGui::CalcTextSize(longer.c_str()).x > room) break;
    shown = longer;
  }
  return shown;
}

bool begin_combo(const char* id, const std::string& chosen, ImGuiComboFlags flags) {
  const float room = ImGui::CalcItemWidth() - ImGui::GetFrameHeight() - ImGui::GetStyle().FramePadding.x;
  const std::string shown = shortened(chosen, room);
  const bool open = ImGui::BeginCombo(id, shown.c_str(), flags);
  if (!open && shown != chosen) tooltip(chosen);
  return open;
}

void same_line_for(const char* label, bool has_box) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const float text = ImGui::CalcTextSize(label).x;
  const float width =
      has_box ? ImGui::GetFrameHeight() + style.ItemInnerSpacing.x + text : text + 2 * style.FramePadding.x;
  const float right = ImGui::GetWindowPos().x + ImGui::GetContentRegionMax().x;
  if (ImGui::GetItemRectMax().x + style.ItemSpacing.x + width <= right) ImGui::SameLine();
}

}  // namespace penumbra::viewer

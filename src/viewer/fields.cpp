#include "viewer/fields.h"

#include <fmt/format.h>
#include <fmt/printf.h>
#include <imgui_stdlib.h>
// Dear ImGui has no other way to ask whether a slider takes text.
#include <imgui_internal.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace penumbra::viewer {

namespace {

constexpr int vector_parts = 3;

float width_of(const std::string& text) { return ImGui::CalcTextSize(text.c_str()).x; }

float item_width() { return ImGui::GetItemRectSize().x; }

// Of each of several fields beside each other that together are so wide.
float part_width(float width, int parts) {
  const auto count = static_cast<float>(parts);
  return (width - (count - 1) * ImGui::GetStyle().ItemInnerSpacing.x) / count;
}

// What is left for the text of a field that is typed into.
float typed_room(float width) { return width - 2 * ImGui::GetStyle().FramePadding.x; }

std::string id_of(const std::string& name) { return "##" + name; }

std::string with_decimals(float value, int decimals) { return fmt::format("{:.{}f}", value, decimals); }

std::string longest_text(const glm::vec3& value, int decimals) {
  const std::array texts{with_decimals(value.x, decimals), with_decimals(value.y, decimals),
                         with_decimals(value.z, decimals)};
  return *std::ranges::max_element(texts, {}, width_of);
}

// How many of `most` have room; 0 also where not even whole numbers have.
int fitting_decimals(const glm::vec3& value, int most, float room) {
  int decimals = most;
  while (decimals > 0 && width_of(longest_text(value, decimals)) > room) --decimals;
  return decimals;
}

// All that a field shows only a part of, while the pointer is over it.
void tell_all(WidgetMap& widgets, const std::string& name, const std::string& text) {
  if (!ImGui::IsItemHovered() || ImGui::IsItemActive()) return;
  widgets.mark("all of " + name);
  show_tooltip(text);
}

// Names the widget that was drawn last, which shows `shown` of `decimals`.
void finish_vector(WidgetMap& widgets, const std::string& name, const glm::vec3& value, int shown, int decimals) {
  widgets.mark(name);
  if (shown == decimals) return;
  tell_all(widgets, name,
           fmt::format("{}, {}, {}", with_decimals(value.x, decimals), with_decimals(value.y, decimals),
                       with_decimals(value.z, decimals)));
}

bool is_finite(float value) { return std::isfinite(value); }
bool is_finite(const glm::vec3& value) { return is_finite(value.x) && is_finite(value.y) && is_finite(value.z); }

// What `edit` returns, whether the user changed the value. Where that gives no finite number the value stays as it was:
// Dear ImGui takes + * / before what is typed as operators on the old value, and its limits stop infinity but not a
// NaN.
template <typename Value, typename Edit>
bool edit_finite(Value& value, const Edit& edit) {
  const Value before = value;
  const bool changed = edit();
  if (is_finite(value)) return changed;
  value = before;
  return false;
}

// The slider that `draw` draws, with its value at its right, where the grab never covers it: Dear ImGui's own is in the
// middle of the slider.
template <typename Value, typename Draw>
bool slider_with_value(WidgetMap& widgets, const std::string& name, const Value& value, Value least, Value most,
                       const char* format, const Draw& draw) {
  const float gap = ImGui::GetStyle().ItemInnerSpacing.x, whole = ImGui::CalcItemWidth();
  const auto text_width = [&](Value each) { return width_of(fmt::sprintf(format, each)); };
  // So much that the slider keeps its length while its value changes, but no more than a half, unless the value needs
  // it.
  const float usual = std::max({text_width(least), text_width(most), 4.5f * ImGui::GetFontSize()});
  const float room = std::max(std::min(usual, whole / 2), text_width(value));
  const std::string id = id_of(name);
  ImGui::BeginGroup();
  ImGui::SetNextItemWidth(std::max(whole - room - gap, 1.0f));
  const bool typed = ImGui::TempInputIsActive(ImGui::GetID(id.c_str()));
  if (!typed) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0, 0, 0, 0));
  const bool changed = draw(id.c_str());
  if (!typed) ImGui::PopStyleColor();
  widgets.mark(name);
  const std::string text = fmt::sprintf(format, value);
  ImGui::SameLine(0, gap + std::max(room - width_of(text), 0.0f));
  ImGui::TextUnformatted(text.c_str());
  mark_field(widgets, name + " value", text, room);
  ImGui::EndGroup();
  return changed;
}

}  // namespace

void mark_field(WidgetMap& widgets, std::string_view name, const std::string& text, float room) {
  widgets.mark(name);
  if (width_of(text) > room) widgets.mark(fmt::format("clipped text of {}", name));
}

bool slider(WidgetMap& widgets, const std::string& name, float& value, float least, float most, const char* format,
            ImGuiSliderFlags flags) {
  return slider_with_value(widgets, name, value, least, most, format, [&](const char* id) {
    return edit_finite(value, [&] {
      return ImGui::SliderFloat(id, &value, least, most, format, flags | ImGuiSliderFlags_AlwaysClamp);
    });
  });
}

bool slider(WidgetMap& widgets, const std::string& name, int& value, int least, int most, const char* format,
            ImGuiSliderFlags flags) {
  return slider_with_value(widgets, name, value, least, most, format, [&](const char* id) {
    return ImGui::SliderInt(id, &value, least, most, format, flags | ImGuiSliderFlags_AlwaysClamp);
  });
}

bool drag(WidgetMap& widgets, const std::string& name, float& value, float speed, const char* format) {
  const bool changed =
      edit_finite(value, [&] { return ImGui::DragFloat(id_of(name).c_str(), &value, speed, 0, 0, format); });
  mark_field(widgets, name, fmt::sprintf(format, value), item_width());
  return changed;
}

bool color_field(WidgetMap& widgets, const std::string& name, glm::vec3& color) {
  const bool changed =
      edit_finite(color, [&] { return ImGui::ColorEdit3(id_of(name).c_str(), &color.x, ImGuiColorEditFlags_Float); });
  const float numbers = item_width() - ImGui::GetFrameHeight() - ImGui::GetStyle().ItemInnerSpacing.x;
  mark_field(widgets, name, longest_text(color, 3), part_width(numbers, vector_parts));
  return changed;
}

void progress(WidgetMap& widgets, const std::string& name, float share, const std::string& text) {
  ImGui::ProgressBar(share, {-1, 0}, text.c_str());
  mark_field(widgets, name, text, item_width());
}

bool type_vector(WidgetMap& widgets, const std::string& name, glm::vec3& value, int decimals) {
  const float room = typed_room(part_width(ImGui::CalcItemWidth(), vector_parts));
  const int shown = fitting_decimals(value, decimals, room);
  const std::string format = fmt::format("%.{}f", shown);
  const bool changed =
      edit_finite(value, [&] { return ImGui::InputFloat3(id_of(name).c_str(), &value.x, format.c_str()); });
  finish_vector(widgets, name, value, shown, decimals);
  return changed;
}

bool drag_vector(WidgetMap& widgets, const std::string& name, glm::vec3& value, float limit, int decimals) {
  const float room = part_width(ImGui::CalcItemWidth(), vector_parts);
  const int shown = fitting_decimals(value, decimals, room);
  const std::string format = fmt::format("%.{}f", shown);
  // Dragging rounds to what is shown, unless that leaves out decimals: a lamp 1,000 m away moves by less than a metre.
  const ImGuiSliderFlags rounding = shown == decimals ? 0 : ImGuiSliderFlags_NoRoundToFormat;
  const bool changed = edit_finite(value, [&] {
    return ImGui::DragFloat3(id_of(name).c_str(), &value.x, 0.01f, -limit, limit, format.c_str(),
                             rounding | ImGuiSliderFlags_AlwaysClamp);
  });
  finish_vector(widgets, name, value, shown, decimals);
  return changed;
}

bool type_range(WidgetMap& widgets, const std::string& name, int& first, int& last) {
  std::array values{first, last};
  const bool changed = ImGui::InputInt2(id_of(name).c_str(), values.data());
  first = values[0];
  last = values[1];
  const std::string longest = std::to_string(std::max(first, last));
  mark_field(widgets, name, longest, typed_room(part_width(item_width(), 2)));
  return changed;
}

bool text_field(WidgetMap& widgets, const std::string& name, std::string& text, const char* hint,
                ImGuiInputTextFlags flags) {
  const bool entered = ImGui::InputTextWithHint(id_of(name).c_str(), hint, &text, flags);
  const float room = typed_room(item_width());
  if (text.empty()) {
    mark_field(widgets, name, hint, room);
  } else {
    widgets.mark(name);
    if (width_of(text) > room) tell_all(widgets, name, text);
  }
  return entered;
}

}  // namespace penumbra::viewer

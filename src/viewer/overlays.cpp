#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "session/techniques.h"
#include "viewer/detail.h"
#include "viewer/panels.h"
#include "viewer/targets.h"

namespace penumbra::viewer {

namespace {

constexpr ImGuiWindowFlags overlay_flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                           ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;

bool begin_overlay(const char* name, const ImVec2& place, const ImVec2& pivot, ImGuiWindowFlags flags = overlay_flags,
                   float alpha = 0.92f) {
  ImGui::SetNextWindowPos(place, ImGuiCond_Always, pivot);
  ImGui::SetNextWindowBgAlpha(alpha);
  return ImGui::Begin(name, nullptr, flags);
}

void end_overlay(const Panel& panel, const char* name) {
  const ImVec2 low = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  panel.widgets.mark(name, low, {low.x + size.x, low.y + size.y});
  ImGui::End();
}

ImVec2 inner(const ImVec2& corner, float x, float y) {
  const float gap = ImGui::GetStyle().WindowPadding.x;
  return {corner.x + x * gap, corner.y + y * gap};
}

struct Key {
  const char* keys;
  const char* what;
};
constexpr std::array keys{
    Key{"left drag", "orbit (in fly mode: look around); a lamp by its ring"},
    Key{"middle drag, Shift + left", "pan"},
    Key{"wheel", "move nearer or farther"},
    Key{"Ctrl + wheel", "magnify pixels"},
    Key{"0", "fit the picture, or the texture, into the view"},
    Key{"right drag", "move the sun"},
    Key{"W A S D Q E", "move; faster with Shift"},
    Key{"F", "fly mode"},
    Key{"Home", "show all that casts shadows, unmagnified"},
    Key{"1 to 9", "go to a bookmark of the camera; with Ctrl: store it"},
    Key{"Space", "play and pause"},
    Key{"left, right", "previous frame, next frame"},
    Key{"C", "compare A with B, or stop"},
    Key{"X", "switch between A and B alone"},
    Key{"T", "tint the picture by cascade, or stop"},
    Key{"P", "show values under the cursor"},
    Key{"L", "lock these values to their pixel, or unlock"},
    Key{"Tab", "show or hide panel and menus"},
    Key{"/, Ctrl + F", "search parameters"},
    Key{"Ctrl + Z", "undo; with Shift, or Ctrl + Y: redo"},
    Key{"Ctrl + C", "copy the command line"},
    Key{"Ctrl + O", "open a scene or a preset"},
    Key{"Ctrl + S", "save view and preset"},
    Key{"F12", "write the picture"},
    Key{"F1, H", "show or hide this list"},
    Key{"arrows, Space", "in an open list: move, and choose; in a question also Enter"},
    Key{"Escape, Ctrl + Q", "close the window; Escape first an open list"},
};

}  // namespace

void help_overlay(const Panel& panel) {
  if (!panel.state.help) return;
  const ImGuiStyle& style = ImGui::GetStyle();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowSizeConstraints({0, 0}, {size.x, std::max(size.y - 2 * style.WindowPadding.y, 1.0f)});
  if (begin_overlay("keys", {size.x * 0.5f, size.y * 0.5f}, {0.5f, 0.5f}, overlay_flags & ~ImGuiWindowFlags_NoScrollbar,
                    /* alpha= */ 1)) {
    ImGui::TextUnformatted("Mouse and keys");
    ImGui::Separator();
    float left = 0, right = 0;
    for (const Key& key : keys) {
      left = std::max(left, ImGui::CalcTextSize(key.keys).x);
      right = std::max(right, ImGui::CalcTextSize(key.what).x);
    }
    // Two columns where one would be higher than the window, if there is room. What is too wide wraps, and what is too
    // high scrolls.
    const float room = wrap_width(1000.0f, size.x) - style.ScrollbarSize, gap = 2 * style.CellPadding.x;
    const bool fits = static_cast<float>(keys.size() + 3) * ImGui::GetTextLineHeightWithSpacing() < size.y;
    const std::size_t columns = fits || 2 * (left + right) + 3 * gap > room ? 1 : 2;
    const std::size_t rows = (keys.size() + columns - 1) / columns;
    ImGui::BeginTable("keys", static_cast<int>(2 * columns), ImGuiTableFlags_SizingFixedFit);
    for (std::size_t i = 0; i < columns; ++i) {
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, left);
      ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, std::clamp(room - left - gap, 1.0f, right));
    }
    ImGui::PushTextWrapPos(0);
    for (std::size_t i = 0; i < rows * columns; ++i) {
      const std::size_t place = i % columns * rows + i / columns;
      ImGui::TableNextColumn();
      if (place < keys.size())
        ImGui::TextColored(ImGui::GetStyleColorVec4(ImGuiCol_CheckMark), "%s", keys.at(place).keys);
      ImGui::TableNextColumn();
      if (place < keys.size()) ImGui::TextUnformatted(keys.at(place).what);
    }
    ImGui::PopTextWrapPos();
    ImGui::EndTable();
  }
  end_overlay(panel, "keys");
}

void messages_overlay(const Panel& panel, const ImVec2& corner, double now) {
  std::deque<Message>& messages = panel.state.messages;
  std::erase_if(messages, [now](const Message& message) { return message.until < now; });
  if (messages.empty()) return;
  // The mouse reaches the picture below, which a message may cover for seconds.
  if (begin_overlay("messages", inner(corner, 1, -1), {0, 1}, overlay_flags | ImGuiWindowFlags_NoInputs)) {
    ImGui::PushTextWrapPos(wrap_width(40.0f, ImGui::GetIO().DisplaySize.x - corner.x));
    for (const Message& message : messages) {
      const ImVec4 color = message.is_error ? ImVec4(1.0f, 0.45f, 0.38f, 1) : ImGui::GetStyleColorVec4(ImGuiCol_Text);
      ImGui::TextColored(color, "%s", message.text.c_str());
    }
    ImGui::PopTextWrapPos();
  }
  end_overlay(panel, "messages");
}

void shader_errors_overlay(const Panel& panel, const ImVec2& corner) {
  if (panel.status.shader_errors.empty()) return;
  if (begin_overlay("shader errors", inner(corner, 1, 1), {0, 0})) {
    ImGui::PushTextWrapPos(wrap_width(44.0f, ImGui::GetIO().DisplaySize.x - corner.x));
    ImGui::TextColored({1.0f, 0.45f, 0.38f, 1}, "%s",
                       panel.status.undrawable ? "A shader does not compile, and there is no version of it that did."
                                               : "A shader does not compile. Its last good version is used.");
    for (const std::string& error : panel.status.shader_errors) ImGui::TextUnformatted(error.c_str());
    ImGui::PopTextWrapPos();
  }
  end_overlay(panel, "shader errors");
}

void no_scene_overlay(const Panel& panel, const ImVec2& middle, float room) {
  if (panel.status.scene != nullptr || panel.status.load_error.empty()) return;
  if (begin_overlay("no scene", middle, {0.5f, 0.5f})) {
    ImGui::PushTextWrapPos(wrap_width(40.0f, room));
    ImGui::TextColored({1.0f, 0.45f, 0.38f, 1}, "%s", panel.status.load_error.c_str());
    ImGui::TextUnformatted("Ctrl + O opens another one.");
    ImGui::PopTextWrapPos();
  }
  end_overlay(panel, "no scene");
}

namespace {

void color_bar(const Panel& panel) {
  const ColorMapping& mapping = panel.status.mapping;
  const Range& range = panel.status.range;
  constexpr int steps = 64;
  const float width = ImGui::GetFontSize() * 12.0f, height = ImGui::GetFontSize() * 0.7f;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  for (int i = 0; i < steps; ++i) {
    const glm::vec3 color = color_at(mapping.scale, static_cast<float>(i) / (steps - 1));
    const float left = at.x + width * static_cast<float>(i) / steps;
    ImGui::GetWindowDrawList()->AddRectFilled({left, at.y}, {left + width / steps + 1, at.y + height},
                                              ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, 1}));
  }
  ImGui::Dummy({width, height});
  const std::string low = fmt::format("{:.4g}", range.low);
  const std::string high = fmt::format("{:.4g} {}", range.high, mapping.unit);
  ImGui::TextUnformatted(low.c_str());
  ImGui::SameLine(ImGui::GetStyle().WindowPadding.x + width - ImGui::CalcTextSize(high.c_str()).x);
  ImGui::TextUnformatted(high.c_str());
}

// The maps of the light that has most.
DrawnMaps most_maps(const ViewerStatus& status) {
  DrawnMaps most;
  for (const DrawnMaps& maps : status.drawn_maps) most = maps.layers > most.layers ? maps : most;
  return most;
}

void label_list(const Panel& panel) {
  const ColorMapping& mapping = panel.status.mapping;
  std::size_t count = mapping.labels.size();
  if (panel.state.inspection.what == "cascade")
    count = std::min(count, static_cast<std::size_t>(most_maps(panel.status).layers));
  for (std::size_t i = 0; i < count; ++i) {
    const glm::vec3 color = color_at(mapping.scale, static_cast<float>(i));
    ImGui::ColorButton(mapping.labels[i].c_str(), {color.r, color.g, color.b, 1},
                       ImGuiColorEditFlags_NoTooltip | ImGuiColorEditFlags_NoDragDrop,
                       {ImGui::GetFontSize(), ImGui::GetFontSize()});
    ImGui::SameLine();
    ImGui::TextUnformatted(mapping.labels[i].c_str());
    panel.widgets.mark("label=" + mapping.labels[i]);
  }
}

// The value under the cursor, in the terms of what is shown.
void texel_line(const Panel& panel) {
  const glm::ivec2& size = panel.status.shown_size;
  if (size.x == 0) return;
  if (!panel.status.texel) {
    ImGui::TextDisabled("%d × %d", size.x, size.y);
    return;
  }
  const std::string text = fmt::format("{}, {} of {} × {}:  {}", panel.status.texel->at.x, panel.status.texel->at.y,
                                       size.x, size.y, panel.status.texel->value);
  ImGui::TextUnformatted(text.c_str());
  panel.widgets.mark("texel=" + text);
}

}  // namespace

void legend_overlay(const Panel& panel, const ImVec2& corner, float room) {
  if (panel.state.inspection.what.empty()) return;
  if (begin_overlay("legend", inner(corner, -1, 1), {1, 0})) {
    ImGui::PushTextWrapPos(wrap_width(44.0f, room));
    const std::string title = title_of(panel.state.inspection, panel.status.gl, panel.status.scene);
    ImGui::TextUnformatted(title.c_str());
    panel.widgets.mark("legend=" + title);
    switch (panel.status.mapping.scale) {
      case ColorScale::labels:
        label_list(panel);
        break;
      case ColorScale::grey:
      case ColorScale::heat:
        color_bar(panel);
        break;
      case ColorScale::vectors:
        ImGui::Text("x, y, z as red, green, blue; grey is 0, white %.4g %s", panel.status.range.high,
                    panel.status.mapping.unit.c_str());
        break;
      case ColorScale::rgb:
        ImGui::Text("linear, %.4g to %.4g", panel.status.range.low, panel.status.range.high);
        break;
    }
    texel_line(panel);
    ImGui::PopTextWrapPos();
  }
  end_overlay(panel, "legend");
}

namespace {

// A part of the status line. Where there is no room for all, those of the lowest ranks are left out.
struct StatusPart {
  int rank = 0;
  std::string text;
};

std::vector<StatusPart> status_parts(const Panel& panel) {
  const ViewerStatus& status = panel.status;
  std::vector<StatusPart> parts;
  if (!status.loading.empty()) parts.push_back({7, "loading " + status.loading});
  if (status.tracing) parts.push_back({6, fmt::format("tracing {:.0f} %", *status.tracing * 100)});
  if (status.scene != nullptr) {
    const glm::ivec2 full(panel.state.document.options.size.width, panel.state.document.options.size.height);
    std::string size = fmt::format("{} × {}", status.drawn_size.x, status.drawn_size.y);
    if (status.drawn_size != full) size += fmt::format(" of {} × {}", full.x, full.y);
    parts.push_back({3, size});
    const Detail detail = effective(panel.state.document.params, status.detail);
    const DrawnMaps maps = most_maps(status);
    if (detail.maps > 1 && maps.layers > 0) parts.push_back({2, fmt::format("maps {} × {}²", maps.layers, maps.size)});
    if (detail.reads > 1) parts.push_back({2, fmt::format("taps 1/{}", detail.reads)});
    if (status.costs_a.frame() > 0) parts.push_back({4, fmt::format("{:.1f} ms", status.costs_a.frame())});
    parts.push_back({1, session::technique_label(panel.state.document.params)});
    parts.push_back({5, status.undrawable ? "not drawn" : status.idle ? "idle" : text_of(status.progress)});
  }
  if (status.device.software) parts.push_back({0, "software rasteriser"});
  return parts;
}

std::string joined(const std::vector<StatusPart>& parts) {
  std::string text;
  for (const StatusPart& part : parts) text += (text.empty() ? "" : "   ") + part.text;
  return text;
}

}  // namespace

void status_bar(const Panel& panel) {
  const ImGuiStyle& style = ImGui::GetStyle();
  const char* name = "Panel";
  const float button = ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(name).x - 2 * style.FramePadding.x;
  const float room = button - style.WindowPadding.x - 2 * style.ItemSpacing.x;
  std::vector<StatusPart> parts = status_parts(panel);
  const std::string whole = joined(parts);
  while (parts.size() > 1 && ImGui::CalcTextSize(joined(parts).c_str()).x > room)
    parts.erase(std::ranges::min_element(parts, {}, &StatusPart::rank));
  const std::string text = shortened(joined(parts), room);
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(text.c_str());
  panel.widgets.mark("status");
  if (text.find("history reset") != std::string::npos) panel.widgets.mark("history reset");
  if (panel.status.undrawable) panel.widgets.mark("not drawn");
  if (text != whole) tooltip(whole);

  const char* help = "F1 keys";
  const float width = ImGui::CalcTextSize(help).x + 2 * style.ItemSpacing.x;
  if (ImGui::CalcTextSize(text.c_str()).x + 2 * style.ItemSpacing.x + width <= room) {
    ImGui::SameLine(button - width);
    ImGui::TextDisabled("%s", help);
  }
  ImGui::SameLine(button);
  if (ImGui::Button(name)) panel.state.panel = !panel.state.panel;
  panel.widgets.mark("show panel");
  tooltip("Shows or hides panel and menus (Tab)");
}

namespace {

// A text that would cover the picture, without its middle.
std::string without_middle(const std::string& text) {
  constexpr std::size_t most = 600;
  if (text.size() <= most) return text;
  // Characters of UTF-8 go on with bytes 10xxxxxx.
  const auto begins = [&](std::size_t at) { return (static_cast<unsigned char>(text[at]) & 0xc0U) != 0x80U; };
  std::size_t first = most / 2, last = text.size() - most / 2;
  while (first > 0 && !begins(first)) --first;
  while (!begins(last)) ++last;
  return text.substr(0, first) + " ... " + text.substr(last);
}

void add(UiState& state, Message message) {
  constexpr std::size_t most = 4;
  const auto same = [&](const Message& other) { return other.text == message.text; };
  std::erase_if(state.messages, same);
  state.messages.push_back(std::move(message));
  if (state.messages.size() > most) state.messages.pop_front();
}

}  // namespace

void tell(UiState& state, const std::string& text, double now, std::string_view replaced) {
  const auto is_replaced = [&](const Message& other) { return other.text.starts_with(replaced); };
  if (!replaced.empty()) std::erase_if(state.messages, is_replaced);
  add(state, {without_middle(text), false, now + 6});
}

void withdraw(UiState& state, const std::string& text) {
  const std::string told = without_middle(text);
  std::erase_if(state.messages, [&](const Message& message) { return message.text == told; });
}

void tell_error(UiState& state, const std::string& text, double now) {
  add(state, {without_middle(text), true, now + 20});
}

}  // namespace penumbra::viewer

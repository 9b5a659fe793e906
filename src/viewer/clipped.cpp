#include "viewer/clipped.h"

#include <fmt/format.h>
#include <imgui.h>
// Dear ImGui has no other way to ask how much room contents have taken.
#include <imgui_internal.h>

#include <algorithm>
#include <string>

namespace penumbra::viewer {

namespace {

constexpr float rounding = 1;  // pixels by which positions may differ

void mark(WidgetMap& widgets, const std::string& what, const ImRect& box) {
  widgets.mark("clipped " + what, box.Min, box.Max);
}

bool is_interface(const ImGuiWindow& window) {
  return window.WasActive && window.Active && !window.Hidden && window.HiddenFramesCanSkipItems == 0;
}

void look_at(const ImGuiWindow& window, const ImVec2& screen, WidgetMap& widgets) {
  const ImVec2 used = window.DC.CursorMaxPos;
  const std::string name = window.Name;
  if (!window.ScrollbarX && used.x > window.WorkRect.Max.x + rounding) mark(widgets, "width of " + name, window.Rect());
  // A bar of menus counts as outside of the room for contents.
  const bool is_bar = (window.Flags & ImGuiWindowFlags_MenuBar) != 0;
  const bool scrolls = (window.Flags & ImGuiWindowFlags_NoScrollbar) == 0;
  const bool is_cut = !scrolls && used.y > window.WorkRect.Max.y + rounding;
  const bool is_slit = window.ScrollMax.y > 0 && window.InnerRect.GetHeight() < 2 * ImGui::GetFontSize();
  if (!is_bar && (is_cut || is_slit)) mark(widgets, "height of " + name, window.Rect());
  const bool within =
      ImRect({-rounding, -rounding}, {screen.x + rounding, screen.y + rounding}).Contains(window.Rect());
  if ((window.Flags & ImGuiWindowFlags_ChildWindow) == 0 && !within) mark(widgets, "place of " + name, window.Rect());
}

void look_at(const ImGuiTable& table, WidgetMap& widgets) {
  for (int i = 0; i < table.ColumnsCount; ++i) {
    const ImGuiTableColumn& column = table.Columns[i];
    const float used = std::max(column.ContentMaxXFrozen, column.ContentMaxXUnfrozen);
    if (column.IsEnabled && column.IsVisibleX && used > column.MaxX + rounding)
      mark(widgets, fmt::format("column {} of a table in {}", i, table.OuterWindow->Name), column.ClipRect);
  }
}

void look_at(const ImGuiTabBar& bar, WidgetMap& widgets) {
  const bool cut = std::any_of(bar.Tabs.begin(), bar.Tabs.end(),
                               [](const ImGuiTabItem& tab) { return tab.Width < tab.ContentWidth - rounding; });
  if (cut || bar.WidthAllTabs > bar.BarRect.GetWidth() + rounding) mark(widgets, "tabs", bar.BarRect);
}

}  // namespace

void mark_clipped(WidgetMap& widgets) {
  ImGuiContext& context = *ImGui::GetCurrentContext();
  for (const ImGuiWindow* window : context.Windows) {
    if (is_interface(*window)) look_at(*window, context.IO.DisplaySize, widgets);
  }
  for (int i = 0; i < context.Tables.GetMapSize(); ++i) {
    const ImGuiTable* table = context.Tables.TryGetMapData(i);
    if (table != nullptr && table->LastFrameActive == context.FrameCount) look_at(*table, widgets);
  }
  for (int i = 0; i < context.TabBars.GetMapSize(); ++i) {
    const ImGuiTabBar* bar = context.TabBars.TryGetMapData(i);
    if (bar != nullptr && bar->CurrFrameVisible == context.FrameCount) look_at(*bar, widgets);
  }
}

}  // namespace penumbra::viewer

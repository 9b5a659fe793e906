#include "viewer/theme.h"

#include <imgui.h>

namespace penumbra::viewer {

namespace {

ImVec4 grey(float level, float alpha = 1.0f) { return {level, level, level + 0.005f, alpha}; }
ImVec4 accent(float alpha) { return {0.93f, 0.66f, 0.25f, alpha}; }

}  // namespace

void set_theme(float scale) {
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowRounding = 0;
  style.FrameRounding = 3;
  style.GrabRounding = 3;
  style.TabRounding = 3;
  style.PopupRounding = 3;
  style.ScrollbarRounding = 3;
  style.WindowPadding = {10, 10};
  style.FramePadding = {6, 4};
  style.ItemSpacing = {8, 5};
  style.WindowBorderSize = 0;
  style.ScrollbarSize = 12;
  ImVec4* colors = style.Colors;
  colors[ImGuiCol_Text] = grey(0.90f);
  colors[ImGuiCol_TextDisabled] = grey(0.58f);
  colors[ImGuiCol_WindowBg] = grey(0.125f);
  colors[ImGuiCol_PopupBg] = grey(0.15f, 0.98f);
  colors[ImGuiCol_TitleBg] = colors[ImGuiCol_TitleBgActive] = grey(0.20f);
  colors[ImGuiCol_ModalWindowDimBg] = grey(0.05f, 0.5f);
  colors[ImGuiCol_FrameBg] = grey(0.20f);
  colors[ImGuiCol_FrameBgHovered] = grey(0.26f);
  colors[ImGuiCol_FrameBgActive] = grey(0.30f);
  colors[ImGuiCol_Button] = grey(0.24f);
  colors[ImGuiCol_ButtonHovered] = grey(0.31f);
  colors[ImGuiCol_ButtonActive] = grey(0.37f);
  colors[ImGuiCol_Header] = grey(0.24f);
  colors[ImGuiCol_HeaderHovered] = grey(0.27f);
  colors[ImGuiCol_HeaderActive] = grey(0.31f);
  colors[ImGuiCol_Tab] = grey(0.16f);
  colors[ImGuiCol_TabHovered] = grey(0.30f);
  colors[ImGuiCol_TabActive] = grey(0.26f);
  // Dark enough to read the value's text, which is drawn over it.
  colors[ImGuiCol_SliderGrab] = {0.55f, 0.38f, 0.13f, 1};
  colors[ImGuiCol_SliderGrabActive] = {0.66f, 0.46f, 0.16f, 1};
  colors[ImGuiCol_CheckMark] = accent(1.0f);
  colors[ImGuiCol_PlotHistogram] = accent(0.85f);
  colors[ImGuiCol_PlotLines] = accent(0.85f);
  colors[ImGuiCol_NavHighlight] = accent(0.9f);
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
}

}  // namespace penumbra::viewer

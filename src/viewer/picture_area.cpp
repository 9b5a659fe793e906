#include "viewer/picture_area.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "session/techniques.h"
#include "viewer/lamp_rings.h"

namespace penumbra::viewer {

namespace {

constexpr float turn_per_pixel = 0.006f;   // of the camera, radians
constexpr float light_per_pixel = 0.004f;  // of the sun, radians
constexpr float dolly_per_notch = 0.88f;
constexpr float grip = 6;  // pixels on each side of the line between A and B that take the mouse

void move(const Panel& panel, const CameraRig& rig) { place(panel.state.document, panel.status.scene->prepared, rig); }

void drag_camera(const Panel& panel, const PictureArea& area) {
  const glm::vec2& by = area.dragged;
  CameraRig rig = present_rig(panel.state.document, panel.status.scene->prepared);
  const bool pan = ImGui::IsMouseDown(ImGuiMouseButton_Middle) || ImGui::GetIO().KeyShift;
  if (pan) {
    rig.pan(glm::vec2(-by.x, by.y) / area.size.y);
  } else if (panel.state.fly) {
    rig.look(-by.x * turn_per_pixel, -by.y * turn_per_pixel);
  } else {
    rig.orbit(-by.x * turn_per_pixel, by.y * turn_per_pixel);
  }
  move(panel, rig);
}

void drag_sun(const Panel& panel, const glm::vec2& by) {
  const cli::Direction sun = present_sun(panel.state.document, panel.status.scene->prepared);
  const glm::vec3 to_light = render::direction_to(sun.azimuth, sun.elevation);
  place_sun(panel.state.document, turned_light(to_light, by.x * light_per_pixel, -by.y * light_per_pixel));
}

// Magnifies about the cursor: the point of the picture under it stays there. `halves`: the pictures are side by side,
// and each half of the window has its own centre. `fitted`: the share of the area that the picture takes.
void magnify(Zoom& zoom, float notches, const PictureArea& area, bool halves, const glm::vec2& fitted) {
  const float before = zoom.factor;
  glm::vec2 middle = area.size * 0.5f;
  if (halves) middle.x *= area.cursor->x >= middle.x ? 1.5f : 0.5f;
  zoom.factor = std::clamp(std::exp2(std::round(std::log2(before) + notches)), 0.25f, 32.0f);
  const glm::vec2 from_middle = (*area.cursor - middle) / (area.size * fitted);
  zoom.center = glm::clamp(zoom.center + from_middle / before - from_middle / zoom.factor, 0.0f, 1.0f);
  if (zoom.factor <= 1) zoom.center = glm::vec2(0.5f);
}

void take_wheel(const Panel& panel, const PictureArea& area) {
  const float notches = ImGui::GetIO().MouseWheel;
  if (notches == 0 || !area.cursor) return;
  if (ImGui::GetIO().KeyCtrl) {
    const Comparison& comparison = panel.state.comparison;
    const bool halves = comparison.on && comparison.how == CompareMode::side_by_side;
    magnify(panel.state.zoom, notches > 0 ? 1.0f : -1.0f, area, halves, panel.status.fitted);
  } else if (panel.status.scene != nullptr && !panel.status.texture_alone) {
    CameraRig rig = present_rig(panel.state.document, panel.status.scene->prepared);
    rig.dolly(std::pow(dolly_per_notch, notches));
    move(panel, rig);
    panel.state.last_travel = ImGui::GetTime();
  }
}

// Returns whether the mouse drags the line between A and B.
bool drag_line(const Panel& panel, const PictureArea& area, bool active) {
  Comparison& comparison = panel.state.comparison;
  if (!comparison.on || comparison.how != CompareMode::wipe) return false;
  const float line = area.corner.x + comparison.wipe * area.size.x;
  bool& dragging = panel.state.dragging_line;
  const float cursor = ImGui::GetIO().MousePos.x;
  const bool near_line = area.cursor && std::abs(cursor - line) <= grip;
  if (near_line || dragging) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (ImGui::IsItemClicked() && near_line) dragging = true;
  if (!active || !ImGui::IsMouseDown(ImGuiMouseButton_Left)) dragging = false;
  if (dragging) comparison.wipe = std::clamp(comparison.wipe + area.dragged.x / area.size.x, 0.0f, 1.0f);
  return dragging;
}

// A label on a dark backdrop, so that it can be read over bright and dark pictures: from `left` to `right`, at one of
// these ends. If it has to be shortened, all of it is in a tooltip; `kept` at its end is cut off last.
void label(const Panel& panel, const std::string& name, float left, float right, float top, bool at_right = false,
           const std::string& kept = "") {
  const std::string text = name + kept;
  const float room = right - left, width = ImGui::CalcTextSize(kept.c_str()).x;
  const bool fits = width + ImGui::CalcTextSize("B: ...").x < room;
  const std::string shown = fits ? shortened(name, room - width) + kept : shortened(text, room);
  if (shown.empty()) return;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 size = ImGui::CalcTextSize(shown.c_str());
  const float gap = ImGui::GetStyle().FramePadding.y, x = at_right ? right - size.x : left;
  const ImVec2 low(x - gap, top - gap), high(x + size.x + gap, top + size.y + gap);
  list.AddRectFilled(low, high, IM_COL32(20, 20, 20, 190), gap);
  list.AddText({x, top}, IM_COL32(255, 255, 255, 255), shown.c_str());
  panel.widgets.mark("label " + text, low, high);
  if (shown != text && ImGui::IsItemHovered() && ImGui::IsMouseHoveringRect(low, high)) show_tooltip(text);
}

void draw_line(const Panel& panel, const PictureArea& area) {
  const Comparison& comparison = panel.state.comparison;
  if (!comparison.on) return;
  const float top = area.corner.y, bottom = area.corner.y + area.size.y, gap = ImGui::GetFontSize();
  const float left = area.corner.x + gap, right = area.corner.x + area.size.x - gap;
  const std::string a = "A: " + session::technique_label(panel.state.document.params);
  const std::string b = "B: " + session::technique_label(comparison.params);
  const std::string old = panel.status.b_is_old ? " (not drawn yet)" : "";
  float line = -1;
  if (comparison.how == CompareMode::wipe) line = area.corner.x + comparison.wipe * area.size.x;
  if (comparison.how == CompareMode::side_by_side) line = area.corner.x + 0.5f * area.size.x;
  if (line >= 0) {
    ImGui::GetWindowDrawList()->AddLine({line, top}, {line, bottom}, IM_COL32(255, 255, 255, 200), 1.0f);
    panel.widgets.mark("line", {line - grip, top}, {line + grip, bottom});
    label(panel, a, left, line - gap, bottom - 2 * gap, /* at_right= */ true);
    label(panel, b, line + gap, right, bottom - 2 * gap, /* at_right= */ false, old);
  } else {
    const std::string difference = fmt::format("|A - B| × {:.0f}", comparison.gain);
    const std::string& name = comparison.how == CompareMode::a ? a : comparison.how == CompareMode::b ? b : difference;
    label(panel, name, left, right, bottom - 2 * gap, /* at_right= */ false, &name == &b ? old : "");
  }
}

// A cross about the pixel whose values are locked, which leaves the pixel itself open.
void draw_lock(const Panel& panel, const PictureArea& area) {
  if (!panel.status.locked_at) return;
  const glm::vec2 at = area.corner + *panel.status.locked_at;
  const float inner = 0.5f * panel.state.zoom.factor + 2, outer = inner + 0.6f * ImGui::GetFontSize();
  for (const glm::vec2& way : {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)}) {
    const glm::vec2 from = at + way * inner, to = at + way * outer;
    ImGui::GetWindowDrawList()->AddLine({from.x, from.y}, {to.x, to.y}, IM_COL32(0, 0, 0, 220), 4);
    ImGui::GetWindowDrawList()->AddLine({from.x, from.y}, {to.x, to.y}, IM_COL32(255, 255, 255, 255), 2);
  }
  panel.widgets.mark("locked pixel", {at.x - outer, at.y - outer}, {at.x + outer, at.y + outer});
}

void fly(const Panel& panel, float seconds) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto axis = [](int positive, int negative) {
    return static_cast<float>(ImGui::IsKeyDown(positive)) - static_cast<float>(ImGui::IsKeyDown(negative));
  };
  const glm::vec3 way(axis(GLFW_KEY_D, GLFW_KEY_A), axis(GLFW_KEY_E, GLFW_KEY_Q), axis(GLFW_KEY_S, GLFW_KEY_W));
  // A hand that presses Ctrl + S may let go of Ctrl first.
  bool& with_ctrl = panel.state.travel_keys_with_ctrl;
  with_ctrl = way != glm::vec3(0) && (with_ctrl || io.KeyCtrl);
  if (way == glm::vec3(0) || with_ctrl || panel.status.scene == nullptr) return;
  CameraRig rig = present_rig(panel.state.document, panel.status.scene->prepared);
  const float speed =
      0.25f * std::max(panel.status.scene->prepared.bounds.radius(), 0.1f) * (io.KeyShift ? 4.0f : 1.0f);
  rig.fly(glm::normalize(way) * speed * std::min(seconds, 0.1f));
  move(panel, rig);
  panel.state.last_travel = ImGui::GetTime();
}

// Whether the key of a letter goes down, wherever the keyboard's layout has it: Y and Z change places in some. Where
// the layout has other letters, as in Greek, keys are those of a keyboard with Latin ones.
bool letter_pressed(char letter) {
  for (int key = GLFW_KEY_APOSTROPHE; key <= GLFW_KEY_WORLD_2; ++key) {
    if (!ImGui::IsKeyPressed(key, /* repeat= */ false)) continue;
    const char* name = glfwGetKeyName(key, 0);
    const std::string_view shown = name != nullptr ? name : "";
    const bool latin = shown.size() == 1 && shown[0] >= 'a' && shown[0] <= 'z';
    if ((latin ? shown[0] : 'a' + key - GLFW_KEY_A) == letter) return true;
  }
  return false;
}

void take_letters_with_ctrl(UiState& state) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!io.KeyCtrl) return;
  if (letter_pressed('s')) state.requests.save = true;
  if (letter_pressed('c')) state.requests.copy_command = true;
  if (letter_pressed('o')) state.open_files();
  if (letter_pressed('f')) state.panel = state.focus_search = true;
  if (letter_pressed('q')) state.requests.quit = true;
  const bool z = letter_pressed('z');
  if (z && !io.KeyShift) state.requests.undo = true;
  if ((z && io.KeyShift) || letter_pressed('y')) state.requests.redo = true;
}

// Shift with a digit is "/" on some keyboards.
void take_digits(const Panel& panel) {
  if (ImGui::GetIO().KeyShift || ImGui::GetIO().KeyAlt) return;
  for (int i = 0; i < static_cast<int>(panel.state.bookmarks.size()); ++i) {
    if (!ImGui::IsKeyPressed(GLFW_KEY_1 + i, /* repeat= */ false)) continue;
    (ImGui::GetIO().KeyCtrl ? store_bookmark : use_bookmark)(panel, static_cast<std::size_t>(i));
  }
}

// Keys that stand alone.
void take_letters(const Panel& panel) {
  UiState& state = panel.state;
  const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, /* repeat= */ false); };
  if (pressed(GLFW_KEY_H)) state.help = !state.help;
  if (pressed(GLFW_KEY_TAB)) state.panel = !state.panel;
  if (pressed(GLFW_KEY_F)) state.fly = !state.fly;
  if (pressed(GLFW_KEY_T)) toggle_cascade_tint(state.inspection);
  if (pressed(GLFW_KEY_P)) state.probe = !state.probe;
  if (pressed(GLFW_KEY_L)) toggle_lock(panel);
  if (pressed(GLFW_KEY_0)) state.zoom = {};
  if (pressed(GLFW_KEY_C)) state.compare(!state.comparison.on);
  if (pressed(GLFW_KEY_X) && state.comparison.on)
    state.comparison.how = state.comparison.how == CompareMode::a ? CompareMode::b : CompareMode::a;
}

void take_time_keys(const Panel& panel) {
  UiState& state = panel.state;
  const bool moves = panel.status.scene != nullptr && !panel.status.scene->prepared.scene.animations.empty();
  // While the user moves through the widgets by keyboard, ImGui uses the same keys.
  if (!moves || ImGui::GetIO().NavVisible) return;
  if (ImGui::IsKeyPressed(GLFW_KEY_SPACE, false)) state.playback.playing = !state.playback.playing;
  if (ImGui::IsKeyPressed(GLFW_KEY_RIGHT)) state.document.step(1);
  if (ImGui::IsKeyPressed(GLFW_KEY_LEFT)) state.document.step(-1);
}

}  // namespace

PictureArea picture_area(const Panel& panel, const gl::Texture* shown) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
  PictureArea area{.corner = {corner.x, corner.y}, .size = {std::max(size.x, 1.0f), std::max(size.y, 1.0f)}};
  ImGui::InvisibleButton(
      "picture", {area.size.x, area.size.y},
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonMiddle | ImGuiButtonFlags_MouseButtonRight);
  panel.widgets.mark("picture");
  const bool active = ImGui::IsItemActive();
  area.dragging = active;
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered()) area.cursor = glm::vec2(io.MousePos.x - corner.x, io.MousePos.y - corner.y);
  const glm::vec2 pointer(io.MousePos.x, io.MousePos.y);
  if (!active) panel.state.drag.release();
  if (ImGui::IsItemActivated()) panel.state.drag.press(pointer);
  if (ImGui::IsMousePosValid()) area.dragged = panel.state.drag.move(pointer);
  const bool taken = drag_line(panel, area, active) || drag_lamp(panel, area, active);
  // A texture that is shown alone has no camera.
  if (area.dragged != glm::vec2(0) && !taken && panel.status.scene != nullptr && !panel.status.texture_alone) {
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) {
      drag_sun(panel, area.dragged);
    } else {
      drag_camera(panel, area);
    }
  }
  take_wheel(panel, area);
  if (shown != nullptr) {
    // Textures begin at the bottom, the window at the top.
    // ImGui's textures are pointers, OpenGL's are numbers. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const auto texture = reinterpret_cast<ImTextureID>(static_cast<std::intptr_t>(shown->id()));
    const ImVec2 end(corner.x + area.size.x, corner.y + area.size.y);
    ImGui::GetWindowDrawList()->AddImage(texture, corner, end, {0, 1}, {1, 0});
    draw_line(panel, area);
    draw_lamp_rings(panel, area);
    draw_lock(panel, area);
  }
  return area;
}

void take_keys(const Panel& panel, float seconds) {
  UiState& state = panel.state;
  if (ImGui::GetIO().WantTextInput || state.closing.asks) return;
  const ImGuiIO& io = ImGui::GetIO();
  const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, /* repeat= */ false); };
  if (pressed(GLFW_KEY_ESCAPE)) {
    if (state.help) {
      state.help = false;
    } else if (!state.popup_open) {
      state.requests.quit = true;
    }
  }
  if (pressed(GLFW_KEY_F1)) state.help = !state.help;
  if (pressed(GLFW_KEY_F12)) state.requests.write_picture = true;
  take_letters_with_ctrl(state);
  if (state.popup_open) return;
  // As typed: the key is another one on each kind of keyboard.
  if (io.InputQueueCharacters.contains('/')) state.panel = state.focus_search = true;
  if (pressed(GLFW_KEY_HOME)) state.requests.frame_casters = true;
  if (!io.KeyCtrl && !io.KeyAlt) take_letters(panel);
  take_digits(panel);
  take_time_keys(panel);
  fly(panel, seconds);
}

}  // namespace penumbra::viewer

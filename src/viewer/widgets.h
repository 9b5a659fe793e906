#pragma once

#include <imgui.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/params.h"

namespace penumbra::viewer {

// The rectangles of widgets by name, in pixels from the window's upper left: for scripts that drive the viewer.
class WidgetMap {
 public:
  // Starts a new frame of the interface.
  void begin();
  // Names the widget that was drawn last. If two of a frame get one name, the second is kept.
  void mark(std::string_view name);
  void mark(std::string_view name, const ImVec2& low, const ImVec2& high);
  // Adds the name "idle": all pictures are finished.
  void mark_idle() { mark(idle, {0, 0}, {0, 0}); }
  // Adds the name "drawing": a picture was begun and is not finished yet.
  void mark_drawing() { mark("drawing", {0, 0}, {0, 0}); }
  // Writes all of them as JSON if any changed since the last file and none since the last frame:
  // {"name": [left, top, right, bottom], …}.
  // Throws Error.
  void write_changes(const std::filesystem::path& file);

 private:
  struct Box {
    int left = 0, top = 0, right = 0, bottom = 0;
    bool operator==(const Box&) const = default;
  };
  static constexpr std::string_view idle = "idle";
  std::map<std::string, Box, std::less<>> boxes_, last_, written_;
};

// Height for a part of a panel that scrolls: what is left of it but `below`, and never less than some lines. Where the
// panel scrolls, such a part can be out of sight: then ImGui::BeginChild() returns false, and it must have no tables.
float rest_of_panel(float below = 0);

// A table of rows until end_rows(): each has a label in the left column and a widget in the right one.
void begin_rows(const char* id);
void row(const std::string& label, const std::string& tooltip, bool changed = false);
void end_rows();

// A row for a parameter, made from its declaration. Returns whether `params` changed. A value that the program refuses
// (maps over the limit of memory) changes nothing and sets `fault` to the reason. A value that differs from the one of
// `base`, the technique or preset that is shown, is marked, and a button leads back to that one.
bool param_row(ParamSet& params, const ParamSet& base, const Param& param, WidgetMap& widgets, std::string& fault);

// Text shown while the pointer is over the last widget.
void tooltip(const std::string& text);
// The same, wherever the pointer is.
void show_tooltip(const std::string& text);
// As tooltip(), but below the last widget or above it, so that its value stays readable, and not while it is used.
void tooltip_beside(WidgetMap& widgets, const std::string& text);

// The width at which text of a window that fits its contents is wrapped: `most` times the font's size, if the whole
// window, of `room` pixels, has space for that.
float wrap_width(float most, float room);

// The text, or as much of its beginning as has room, and "…". Empty if not even one letter has.
std::string shortened(const std::string& text, float room);

// As ImGui::BeginCombo(). A chosen word that is too long for the widget is shortened, with all of it in a tooltip.
bool begin_combo(const char* id, const std::string& chosen, ImGuiComboFlags flags = 0);

// Puts the next button or box into the same line, if there is room for it.
void same_line_for(const char* label, bool has_box = false);

// A selectable line of a list with any text: ImGui's own would end it at "##". A text that is too long for the window
// is shortened, with all of it in a tooltip. Returns whether it was clicked.
bool choice(const std::string& text, bool chosen = false, ImGuiSelectableFlags flags = 0);
// Whether the user presses Enter while the item that was drawn last has the keyboard's focus. ImGui itself takes Space.
bool enter_on_item();

}  // namespace penumbra::viewer

#pragma once

#include <imgui.h>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "core/params.h"

namespace penumbra::viewer {

// Where widgets stand, by name, in pixels of the window from its upper left: for scripts that drive the viewer.
class WidgetMap {
 public:
  // A new frame of the interface.
  void begin();
  // The widget that was drawn last has this name; a second one of a name in a frame counts alone.
  void mark(std::string_view name);
  void mark(std::string_view name, const ImVec2& low, const ImVec2& high);
  // "at rest": what is seen stays as it is.
  void mark_rest() { mark(rest, {0, 0}, {0, 0}); }
  // Writes all of them as JSON if any moved since, and have come to rest: {"name": [left, top, right, bottom], …}.
  // Throws Error.
  void write_changes(const std::filesystem::path& file);

 private:
  struct Box {
    int left = 0, top = 0, right = 0, bottom = 0;
    bool operator==(const Box&) const = default;
  };
  static constexpr std::string_view rest = "at rest";
  std::map<std::string, Box, std::less<>> boxes_, last_, written_;
};

// A label in the left column and room for a widget in the right one, until end_rows().
void begin_rows(const char* id);
void row(const std::string& label, const std::string& tooltip, bool changed = false);
void end_rows();

// A row for a parameter, made from its declaration. True: `params` has another value now, in its range; one that the
// program can't take (maps over the limit of memory) leaves it and is told in `fault`.
bool param_row(ParamSet& params, const Param& param, WidgetMap& widgets, std::string& fault);

// Text that appears while the pointer is over the last widget.
void tooltip(const std::string& text);

// A line of a list, whatever is in its text: ImGui ends a label at "##". True: it was chosen.
bool choice(const std::string& text, bool chosen = false, ImGuiSelectableFlags flags = 0);

}  // namespace penumbra::viewer

#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

#include "viewer/state.h"
#include "viewer/status.h"
#include "viewer/widgets.h"

namespace penumbra::viewer {

// What a panel reads and changes.
struct Panel {
  UiState& state;
  const ViewerStatus& status;
  WidgetMap& widgets;
};

// The window's menus. Returns their height.
float menu_bar(const Panel& panel);

// A line of a menu; returns whether it is chosen.
bool menu_item(const Panel& panel, const char* name, const char* keys, bool possible = true);
// As ImGui::BeginMenu().
bool begin_menu(const Panel& panel, const char* name);
void camera_menu(const Panel& panel);

// Locks the values under the cursor to their pixel, or unlocks them.
void toggle_lock(const Panel& panel);

// Bookmarks of cameras, by the number of their key less one. A bookmark that is empty tells how to store it.
void store_bookmark(const Panel& panel, std::size_t index);
void use_bookmark(const Panel& panel, std::size_t index);

// The tabs of the side panel, each a file of its name.
void shadow_panel(const Panel& panel);   // technique, parameters, presets
void scene_panel(const Panel& panel);    // file, camera, sun, lights, time
void inspect_panel(const Panel& panel);  // what is shown, its legend, the values under the cursor
void compare_panel(const Panel& panel);  // picture B
void cost_panel(const Panel& panel);     // passes, memory, the machine
void files_panel(const Panel& panel);    // pictures, sequences, the command line

// The section of the scene panel for the file's lights and the user's lamps.
void lights_panel(const Panel& panel);

// A popup of the scene panel that lists a folder, to open a file. It opens when UiState::files.wanted is set.
void file_browser(const Panel& panel);

// Asks whether to save before the window closes. It opens when UiState::closing.wanted is set.
void closing_question(const Panel& panel);

// Windows over the picture, placed at corners of it, in pixels of the window.
void help_overlay(const Panel& panel);
void messages_overlay(const Panel& panel, const ImVec2& lower_left, double now);
void shader_errors_overlay(const Panel& panel, const ImVec2& upper_left);
// Why a window is empty.
void no_scene_overlay(const Panel& panel, const ImVec2& middle, float room);
void legend_overlay(const Panel& panel, const ImVec2& upper_right, float picture_width);
// At the window's lower edge.
void status_bar(const Panel& panel);

// Shows a message for some seconds; errors stay longer. It takes the place of earlier ones that begin with
// `replaced`, if that is not empty.
void tell(UiState& state, const std::string& text, double now, std::string_view replaced = {});
void tell_error(UiState& state, const std::string& text, double now);
// Takes away a message that no longer holds.
void withdraw(UiState& state, const std::string& text);

}  // namespace penumbra::viewer

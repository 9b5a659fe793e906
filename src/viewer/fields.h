#pragma once

#include <imgui.h>

#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "viewer/widgets.h"

namespace penumbra::viewer {

// Widgets that show a value. Each takes the width that is set for the next item, and its name is that
// of the layout. Where a value has no room, Dear ImGui cuts it off: the layout then has "clipped text of NAME" too, or,
// where a tooltip has all of the value, "all of NAME" while that is shown.

// Names the widget that was drawn last, which shows `text` where there is `room`, pixels.
void mark_field(WidgetMap& widgets, std::string_view name, const std::string& text, float room);

// As ImGui::SliderFloat() and so on, but that a slider's value stands beside it, as "NAME value" of the layout. They
// return whether the user changed the value. What is typed and gives no number changes nothing; an infinite one
// gives the limit, or nothing where there is none.
bool slider(WidgetMap& widgets, const std::string& name, float& value, float least, float most, const char* format,
            ImGuiSliderFlags flags = 0);
bool slider(WidgetMap& widgets, const std::string& name, int& value, int least, int most, const char* format = "%d",
            ImGuiSliderFlags flags = 0);
bool drag(WidgetMap& widgets, const std::string& name, float& value, float speed, const char* format);
bool color_field(WidgetMap& widgets, const std::string& name, glm::vec3& color);
void progress(WidgetMap& widgets, const std::string& name, float share, const std::string& text);

// Three numbers to type, or to drag within limits. They show as many of `decimals`, which is 1 or more, as have room; a
// tooltip has all. Dragging rounds to `decimals` where these have room.
bool type_vector(WidgetMap& widgets, const std::string& name, glm::vec3& value, int decimals);
bool drag_vector(WidgetMap& widgets, const std::string& name, glm::vec3& value, float limit, int decimals);
bool type_range(WidgetMap& widgets, const std::string& name, int& first, int& last);

// A text to type. A tooltip has one that has no room.
bool text_field(WidgetMap& widgets, const std::string& name, std::string& text, const char* hint = "",
                ImGuiInputTextFlags flags = 0);

}  // namespace penumbra::viewer

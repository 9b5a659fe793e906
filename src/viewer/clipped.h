#pragma once

#include "viewer/widgets.h"

namespace penumbra::viewer {

// Marks what the last frame of the interface cut off and no scroll bar reaches, as "clipped …": contents that are wider
// than their window or their column of a table, tabs whose names are cut, and windows that are partly outside of the
// screen. To be called after ImGui::Render().
void mark_clipped(WidgetMap& widgets);

}  // namespace penumbra::viewer

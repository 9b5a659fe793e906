#pragma once

namespace penumbra::viewer {

// Colours and spacing of the whole interface: quiet greys, so that the picture is what the eye goes to. `scale` is
// Window::scale().
void set_theme(float scale);

}  // namespace penumbra::viewer

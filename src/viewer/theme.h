#pragma once

namespace penumbra::viewer {

// Sets colours and spacing of the whole interface: greys, so that the picture stands out. `scale` is
// Window::scale().
void set_theme(float scale);

}  // namespace penumbra::viewer

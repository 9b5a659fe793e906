#pragma once

#include <string>
#include <string_view>

#include "render/view.h"

namespace penumbra::cli {

// The most that a lamp of the user may have: its radius, metres, and its intensity, candela.
constexpr float largest_lamp = 1000;
constexpr double brightest_lamp = 1e12;

// A lamp of the user: "x,y,z", its place in metres, and then, each after a colon and in any order,
//   radius=METRES (0.03)   cd=CANDELA (100)   range=METRES (0: unlimited)   rgb=R,G,B (1,1,1)
//   to=X,Y,Z: a spot that shines there   cone=DEGREES (40): from a spot's axis to its rim
//   inner=DEGREES (0.8 of the cone's): from its axis, within which it shines in full
// Throws UsageError, which names the option, the text and the fault.
render::LampLight parse_lamp(std::string_view option, std::string_view text);
// A text that parse_lamp() reads as the same lamp.
std::string lamp_text(const render::LampLight& lamp);

}  // namespace penumbra::cli

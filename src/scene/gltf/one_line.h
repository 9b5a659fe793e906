#pragma once

#include <string>
#include <string_view>

namespace penumbra::scene::gltf {

// Faults quote the file, which may hold anything: control characters and bytes outside ASCII become '?', and what is
// too long is cut, so that the message stays one printable line.
std::string one_line(std::string_view text);

}  // namespace penumbra::scene::gltf

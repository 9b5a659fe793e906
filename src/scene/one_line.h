#pragma once

#include <string>
#include <string_view>

namespace penumbra::scene {

// Makes a message one printable line. Messages quote the file, which may contain anything: control characters and bytes
// that are not UTF-8 become '?', and long text is cut.
std::string one_line(std::string_view text);

}  // namespace penumbra::scene

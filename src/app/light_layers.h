#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace penumbra::app {

// The name of a light's picture: "shadow" of the first light, "shadow_2" of the second.
std::string layer_name(std::string_view name, std::size_t light);

}  // namespace penumbra::app

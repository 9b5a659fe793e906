#include "app/light_layers.h"

#include <fmt/format.h>

namespace penumbra::app {

std::string layer_name(std::string_view name, std::size_t light) {
  return light == 0 ? std::string(name) : fmt::format("{}_{}", name, light + 1);
}

}  // namespace penumbra::app

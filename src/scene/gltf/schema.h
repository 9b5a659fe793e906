#pragma once

#include <nlohmann/json.hpp>

#include "scene/gltf/left_out.h"

namespace penumbra::scene::gltf {

// Checks every property that the reader uses, and the extensions it knows: type, range, allowed words, array length,
// and that indices point at something. Throws Error naming the property. Afterwards the document can be read without
// surprises. Integers written as floats (3.0), which glTF allows, become integers. Elements with a fault that nothing
// drawn uses are left out: their stand-ins take their place.
void check_schema(nlohmann::json& document, LeftOut& left_out);

}  // namespace penumbra::scene::gltf

#pragma once

#include <nlohmann/json.hpp>

#include "scene/gltf/left_out.h"

namespace penumbra::scene::gltf {

// Checks every property that the reader uses, and the extensions that it knows: types, ranges, allowed words, array
// lengths and indices. Throws Error that names the property. Afterwards the document can be read without further checks
// of these. Integers written as floats (3.0), which glTF allows, become integers. Elements with a fault that nothing
// drawn uses are replaced by placeholders.
void check_schema(nlohmann::json& document, LeftOut& left_out);

}  // namespace penumbra::scene::gltf

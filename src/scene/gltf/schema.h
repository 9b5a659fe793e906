#pragma once

#include <nlohmann/json.hpp>

namespace penumbra::scene::gltf {

// Checks every property that the reader uses, and the extensions it knows: type, range, allowed words, array length,
// and that indices point at something. Throws Error naming the property. Afterwards the document can be read without
// surprises. Integers written as floats (3.0), which glTF allows, become integers.
void check_schema(nlohmann::json& document);

}  // namespace penumbra::scene::gltf

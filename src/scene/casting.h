#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// The words for Casting that files and options use: on, off, both, front, back.
const std::vector<std::string>& casting_words();
std::optional<Casting> casting_of(std::string_view word);

// Sets how the materials of that name cast, over what nodes that draw them say. False: there is none.
bool set_casting(Scene& scene, std::string_view material, Casting casting);

// What a frame's parameters say of all casters.
struct CasterChoice {
  CasterFaces faces = CasterFaces::both;
  bool skies = false;  // skies cast too

  bool operator==(const CasterChoice&) const = default;
};

// Which faces of a node's surface of this material cast; nothing: none does. `casters.faces` leaves double-sided
// materials both faces: neither of theirs is a back.
std::optional<CasterFaces> casting_faces(const Node& node, const Material& material, const CasterChoice& choice);

}  // namespace penumbra::scene

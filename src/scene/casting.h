#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene.h"

namespace penumbra::scene {

// The words for CastSetting that files and options use: on, off, both, front, back.
const std::vector<std::string>& casting_words();
std::optional<CastSetting> casting_of(std::string_view word);

// Sets how the materials of that name cast shadows, overriding the nodes that draw them. Returns false if there is no
// such material.
bool set_casting(Scene& scene, std::string_view material, CastSetting casting);

// Which casters the parameters of a frame choose.
struct CasterChoice {
  CasterFaces faces = CasterFaces::both;
  bool skies = false;  // whether skies cast shadows too
  bool ground = true;  // whether a ground (Node::ground) does: it shadows nothing if all lights shine from above it

  bool operator==(const CasterChoice&) const = default;
};

// Whether only the parameters `casters.*` decide how a node's surface of this material casts shadows.
bool casts_as_parameters_say(const Node& node, const Material& material);

// Which faces cast shadows on a node's surface of this material; nothing if none does. The parameter `casters.faces`
// does not affect double-sided materials, which always cast from both faces.
std::optional<CasterFaces> casting_faces(const Node& node, const Material& material, const CasterChoice& choice);

}  // namespace penumbra::scene

#include "scene/casting.h"

#include <algorithm>

namespace penumbra::scene {

const std::vector<std::string>& casting_words() {
  static const std::vector<std::string> words{"on", "off", "both", "front", "back"};
  return words;
}

std::optional<CastSetting> casting_of(std::string_view word) {
  const auto found = std::ranges::find(casting_words(), word);
  if (found == casting_words().end()) return {};
  constexpr CastSetting values[] = {CastSetting::on, CastSetting::off, CastSetting::both, CastSetting::front,
                                    CastSetting::back};
  return values[found - casting_words().begin()];
}

bool set_casting(Scene& scene, std::string_view material, CastSetting casting) {
  bool found = false;
  for (Material& candidate : scene.materials) {
    if (candidate.name != material) continue;
    candidate.casting = casting;
    candidate.casting_over_nodes = true;
    found = true;
  }
  return found;
}

namespace {

CastSetting decided_casting(const Node& node, const Material& material) {
  const bool of_material = material.casting_over_nodes || node.casting == CastSetting::automatic;
  return of_material ? material.casting : node.casting;
}

}  // namespace

bool casts_as_parameters_say(const Node& node, const Material& material) {
  return decided_casting(node, material) == CastSetting::automatic;
}

std::optional<CasterFaces> casting_faces(const Node& node, const Material& material, const CasterChoice& choice) {
  const CasterFaces chosen = material.double_sided ? CasterFaces::both : choice.faces;
  switch (decided_casting(node, material)) {
    case CastSetting::automatic:
      if (node.sky && !choice.skies) return {};
      if (node.ground && !choice.ground) return {};
      return chosen;
    case CastSetting::on:
      return chosen;
    case CastSetting::off:
      return {};
    case CastSetting::both:
      return CasterFaces::both;
    case CastSetting::front:
      return CasterFaces::front;
    case CastSetting::back:
      return CasterFaces::back;
  }
  return {};
}

}  // namespace penumbra::scene

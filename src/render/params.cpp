#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <span>
#include <variant>

#include "render/passes.h"
#include "render/renderer.h"

namespace penumbra::render {

std::vector<Param> render_params() {
  using enum ParamBinding;
  return {
      {"exposure.auto", true, 0, 1, "", "Chooses the exposure by the picture's brightness; off: uses exposure.ev.",
       host},
      {"exposure.ev", 15.0f, -16, 24, "EV", "Exposure value at ISO 100 when exposure.auto is off.", host},
      {"exposure.compensation", 0.0f, -8, 8, "stops", "Added to the automatic exposure; positive is brighter.", host},
      {"render.sky_light", 0.2f, 0, 4, "",
       "Illuminance of a level plane by the sky under a sun that is 45° high, as a fraction of the sun's on a plane "
       "that "
       "faces it; the sky is darker when the sun is lower. Of lamps: by what they light around a scene.",
       host},
      {"render.haze", 0.1f, 0, 1, "",
       "Optical depth of the haze in the air, which whitens the sky: 0.05 is very clear.", host},
      {"render.ground_light", 0.5f, 0, 1, "",
       "Fraction of the light from the ground around a scene that reaches its surfaces.", host},
      {"render.soft_terminator", true, 0, 1, "",
       "Light fades out on round bodies before their triangles turn away from it, so that those in their own shadow "
       "don't show as teeth.",
       host},
      {"render.dither", true, 0, 1, "",
       "Rounds the picture to 8 bits by blue noise, so that bright surfaces show no bands; off: to the nearest value.",
       host},
      {"casters.faces",
       "both",
       0,
       0,
       "",
       "Triangles that cast: those whose front faces the light (front), those whose back does (back), or both. "
       "Materials "
       "that are double-sided cast from both.",
       host,
       {"both", "front", "back"}},
      {"casters.skies", false, 0, 1, "",
       "Lets shells that enclose the scene, such as sky domes, cast shadows; without it, a warning names them.", host},
  };
}

scene::CasterChoice caster_choice(const ParamSet& params, std::span<const FrameLight> lights,
                                  const shadow::Registry& registry) {
  const auto sine_of_radius = std::sin(0.5f * glm::radians(params.get_float("sun.angle")));
  const auto is_above = [&](const FrameLight& light) {
    const auto* sun = std::get_if<SunLight>(&light);
    return sun != nullptr && sun->to_light.y > sine_of_radius;
  };
  const std::string& faces = params.get_word("casters.faces");
  return {.faces = faces == "front"  ? scene::CasterFaces::front
                   : faces == "back" ? scene::CasterFaces::back
                                     : scene::CasterFaces::both,
          .skies = params.get_bool("casters.skies"),
          .ground =
              !registry.find(params.get_word("technique")).reads_light_discs || !std::ranges::all_of(lights, is_above)};
}

}  // namespace penumbra::render

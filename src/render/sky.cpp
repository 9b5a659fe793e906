#include <optional>
#include <span>

#include "render/passes.h"

namespace penumbra::render {

namespace {

// The sun that the sky is lit by.
std::optional<SunLight> brightest_sun(std::span<const FrameLight> lights, bool on_ground, const ParamSet& params) {
  std::optional<SunLight> found;
  const auto brightness = [](const SunLight& sun) { return sun.illuminance.r + sun.illuminance.g + sun.illuminance.b; };
  for (const bool hidden : {false, true}) {
    for (const FrameLight& light : lights) {
      const SunLight* sun = std::get_if<SunLight>(&light);
      if (sun == nullptr || is_hidden(light, on_ground, params) != hidden) continue;
      if (!found || brightness(*sun) > brightness(*found)) found = *sun;
    }
    if (found) break;
  }
  return found;
}

}  // namespace

void update_sky(Sky& sky, std::span<const FrameLight> lights, bool on_ground, const ParamSet& params) {
  const std::optional<SunLight> sun = brightest_sun(lights, on_ground, params);
  if (!sun && sky.texture) return;
  const glm::vec3 to_sun = sun.value_or(SunLight{}).to_light;
  const float haze = params.get_float("render.haze");
  if (sky.texture && to_sun == sky.to_sun && haze == sky.haze) return;
  if (!sky.atmosphere || haze != sky.haze) sky.atmosphere.emplace(haze);
  sky.table = sky.atmosphere->table(to_sun);
  if (!sky.texture)
    sky.texture = gl::Texture("sky", {.format = GL_RGBA16F, .width = SkyTable::size, .height = SkyTable::size});
  sky.texture.upload(GL_RGBA, GL_FLOAT, std::as_bytes(std::span(sky.table.radiance)));
  sky.haze = haze;
  sky.to_sun = to_sun;
}

}  // namespace penumbra::render

#include "truth/frame_rays.h"

#include <cassert>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <span>
#include <variant>

#include "core/error.h"

namespace penumbra::truth {

namespace {

// A frame's light as the tracer's light: one overload for each kind of shadow::LightSource.
TracedLight light_of(const shadow::Sun& sun, const ParamSet& params) {
  return TracedSun{.to_light = glm::dvec3(sun.to_light),
                   .angle = glm::radians(static_cast<double>(params.get_float("sun.angle"))),
                   .square = params.get_word("sun.shape") == "square"};
}

TracedLight light_of(const shadow::Lamp& lamp, const ParamSet& params) {
  LocalLight light{.position = glm::dvec3(lamp.position),
                   .radius = lamp.radius,
                   .clear = params.get_float("lamps.near"),
                   .range = lamp.range};
  if (lamp.axis != glm::vec3(0)) light.cone = SpotCone{.axis = glm::dvec3(lamp.axis), .cosine = std::cos(lamp.cone)};
  return light;
}

}  // namespace

const render::FrameScene& frame_scene(const shadow::PassContext& frame, const char* technique) {
  const auto* scene = static_cast<const render::FrameScene*>(frame.inputs().user);
  if (scene == nullptr) fail("technique '{}' traces a renderer's scene, and Inputs::user has none", technique);
  return *scene;
}

std::vector<glm::uvec2> drawn_surfaces(gl::Device& device, const render::FrameScene& scene) {
  const gl::Texture& ids =
      render::draw_surface_ids(device, {.scene = scene.scene, .view = scene.view, .depth = scene.depth});
  const std::vector<unsigned> values = gl::read_uints(ids, 2);
  std::vector<glm::uvec2> drawn;
  drawn.reserve(values.size() / 2);
  for (std::size_t i = 0; i < values.size(); i += 2)
    drawn.emplace_back(values[i] == 0 ? no_surface : values[i] - 1, values[i + 1]);
  return drawn;
}

EyeRays eye_rays(const render::FrameScene& scene) {
  return {.clip_to_world = glm::inverse(glm::dmat4(scene.view.world_to_clip)),
          .width = scene.depth.width(),
          .height = scene.depth.height()};
}

TracedLight traced_light(const shadow::PassContext& frame) {
  return std::visit([&](const auto& source) { return light_of(source, frame.params()); }, frame.light().source);
}

void fill_mask(const shadow::PassContext& frame, const std::vector<float>& visibility) {
  const gl::Texture& mask = frame.mask();
  [[maybe_unused]] const shadow::Rect whole{0, 0, mask.width(), mask.height()};
  assert(frame.frame().viewport == whole);
  std::vector<glm::vec4> texels;
  texels.reserve(visibility.size());
  for (const float v : visibility) texels.emplace_back(v, 0.0f, 0.0f, 0.0f);
  mask.upload(GL_RGBA, GL_FLOAT, std::as_bytes(std::span(texels)), 0, frame.frame().layer);
}

}  // namespace penumbra::truth

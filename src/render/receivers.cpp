#include "render/receivers.h"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace penumbra::render {

namespace {

glm::vec3 vector_at(const std::vector<float>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

// What surfaces the frame shows.
struct Surfaces {
  std::vector<float> normals, positions;
};

// The sine of the angle between the sun's centre and the point of it that is farthest from it.
double sine_of_half(const ParamSet& params) {
  const double half = glm::radians(static_cast<double>(params.get_float("sun.angle"))) * 0.5;
  if (params.get_word("sun.shape") != "square") return std::sin(half);
  const double corner = std::numbers::sqrt2 * std::tan(half);
  return corner / std::hypot(1.0, corner);
}

std::vector<std::uint8_t> facing(const Surfaces& surfaces, const SunLight& sun, const ParamSet& params) {
  const std::vector<float>& normals = surfaces.normals;
  const auto least = static_cast<float>(sine_of_half(params));
  std::vector<std::uint8_t> receivers(normals.size() / 3);
  for (std::size_t i = 0; i < receivers.size(); ++i)
    receivers[i] = glm::dot(vector_at(normals, i), sun.to_light) > least ? 1 : 0;
  return receivers;
}

// The lamp is a disc that faces the receiver.
std::vector<std::uint8_t> facing(const Surfaces& surfaces, const LampLight& lamp, const ParamSet& /*params*/) {
  const auto& [normals, positions] = surfaces;
  const float outer = lamp.axis == glm::vec3(0) ? -2.0f : std::cos(lamp.outer_cone);
  std::vector<std::uint8_t> receivers(normals.size() / 3);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const glm::vec3 to_lamp = lamp.position - vector_at(positions, i);
    const float distance = glm::length(to_lamp);
    const float least = distance * lamp.radius / std::hypot(distance, lamp.radius);
    const bool within = lamp.range <= 0 || distance <= lamp.range;
    const bool shines = within && -glm::dot(to_lamp, lamp.axis) >= outer * distance;
    receivers[i] = shines && glm::dot(vector_at(normals, i), to_lamp) > least ? 1 : 0;
  }
  return receivers;
}

}  // namespace

std::vector<std::uint8_t> receivers_of(const Renderer& renderer, std::span<const FrameLight> lights,
                                       const ParamSet& params) {
  const Surfaces surfaces{renderer.read_aov("geometric_normal"), renderer.read_aov("position")};
  std::vector<std::uint8_t> receivers;
  for (const FrameLight& light : lights) {
    const std::vector<std::uint8_t> of_light =
        std::visit([&](const auto& kind) { return facing(surfaces, kind, params); }, light);
    receivers.insert(receivers.end(), of_light.begin(), of_light.end());
  }
  return receivers;
}

std::vector<std::uint8_t> receivers_of(const Renderer& renderer, const FrameLight& light, const ParamSet& params) {
  return receivers_of(renderer, std::span(&light, 1), params);
}

}  // namespace penumbra::render

#include "render/receivers.h"

#include <cmath>
#include <glm/trigonometric.hpp>

namespace penumbra::render {

namespace {

glm::vec3 vector_at(const std::vector<float>& values, std::size_t i) {
  return {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
}

std::vector<std::uint8_t> facing(const Renderer& renderer, const SunLight& sun, double sun_angle) {
  const std::vector<float> normals = renderer.read_aov("geometric_normal");
  const auto least = static_cast<float>(std::sin(glm::radians(sun_angle) * 0.5));
  std::vector<std::uint8_t> receivers(normals.size() / 3);
  for (std::size_t i = 0; i < receivers.size(); ++i)
    receivers[i] = glm::dot(vector_at(normals, i), sun.to_light) > least ? 1 : 0;
  return receivers;
}

// The lamp is a disc that faces the receiver.
std::vector<std::uint8_t> facing(const Renderer& renderer, const LampLight& lamp, double /*sun_angle*/) {
  const std::vector<float> normals = renderer.read_aov("geometric_normal");
  const std::vector<float> positions = renderer.read_aov("position");
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

std::vector<std::uint8_t> receivers_of(const Renderer& renderer, const FrameLight& light, double sun_angle) {
  return std::visit([&](const auto& kind) { return facing(renderer, kind, sun_angle); }, light);
}

}  // namespace penumbra::render

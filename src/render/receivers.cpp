#include "render/receivers.h"

#include <cmath>
#include <glm/trigonometric.hpp>

namespace penumbra::render {

std::vector<std::uint8_t> receivers_of(const Renderer& renderer, const glm::vec3& to_light, double sun_angle) {
  const std::vector<float> normals = renderer.read_aov("geometric_normal");
  const auto least = static_cast<float>(std::sin(glm::radians(sun_angle) * 0.5));
  std::vector<std::uint8_t> receivers(normals.size() / 3);
  for (std::size_t i = 0; i < receivers.size(); ++i) {
    const glm::vec3 normal(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
    receivers[i] = glm::dot(normal, to_light) > least ? 1 : 0;
  }
  return receivers;
}

}  // namespace penumbra::render

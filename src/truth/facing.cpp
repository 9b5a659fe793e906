#include "truth/facing.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace penumbra::truth {

std::vector<float> before_light(std::span<const Receiver> receivers, const TracedLight& light) {
  std::vector<float> before;
  before.reserve(receivers.size());
  for (const Receiver& receiver : receivers) {
    bool all = receiver.there;
    if (all) {
      const SeenLight seen = seen_from(light, receiver.position);
      const double side = glm::length(seen.side_x), distance = glm::length(seen.center);
      const double radius = seen.square ? std::numbers::sqrt2 * side : side;  // a square's is that of its corners
      all = seen.shines && glm::dot(receiver.normal, seen.center) > distance * radius / std::hypot(distance, radius);
    }
    before.push_back(all ? 1.0f : 0.0f);
  }
  return before;
}

std::vector<float> unshadowed(std::span<const Receiver> receivers, const TracedLight& light) {
  std::vector<float> facing;
  facing.reserve(receivers.size());
  for (const Receiver& receiver : receivers) {
    const SeenLight seen = seen_from(light, receiver.position);
    const bool lit = !receiver.there || (seen.shines && glm::dot(receiver.normal, seen.center) > 0);
    facing.push_back(lit ? 1.0f : 0.0f);
  }
  return facing;
}

}  // namespace penumbra::truth

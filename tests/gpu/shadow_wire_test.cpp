// Casters that are narrower than the texels of coarse cascades.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

using ShadowWire = TriangleTest;

constexpr float wire_height = 5, wire_width = 0.002f, sun_angle = 2;  // metres, degrees

// A wire over a wide ground, turned against the texels of the maps, and a camera between the two that sees 2 m of the
// ground.
TriangleScene wire_over_ground() {
  TriangleScene scene;
  scene.add_quad({-60, 0, 60}, {120, 0, 0}, {0, 0, -120});
  const glm::vec3 along(std::cos(0.3f), 0, std::sin(0.3f)), across(-along.z, 0, along.x);
  scene.add_quad(glm::vec3(0, wire_height, 0) - 4.0f * along, 8.0f * along, wire_width * across);
  scene.width = scene.height = 128;
  scene.view = glm::lookAt(glm::vec3(0, 1, 3), glm::vec3(0), glm::vec3(0, 1, 0));
  scene.projection = perspective(glm::radians(60.0f), 1, 0.1f);
  return scene;
}

// The finest maps show parts of the wire, the widest hardly any, so a technique that trusts the widest one to bound its
// search takes the wire for something near the ground, whose shadow is black.
TEST_F(ShadowWire, HighAboveTheGroundLeavesNoDarkPixels) {
  const TriangleScene scene = wire_over_ground();
  const float radius = wire_height * std::tan(glm::radians(sun_angle) / 2);
  for (const std::string technique : {"pcss", "slices", "backprojection", "vssm", "brute_force"}) {
    ParamSet params = renderer_->params();
    params.set("technique", technique);
    params.set("sun.angle", sun_angle);
    const Shadowed shadowed = renderer_->render(scene, params);
    const auto& cascades = renderer_->mask().lights[0].projection.cascades();
    ASSERT_GT(cascades.texel(3).x, 20 * wire_width);
    ASSERT_LT(cascades.texel(0).x, 3 * wire_width);
    // The share of the light that a strip across its middle hides, if the map makes it as wide as two texels.
    const float widest = std::max(wire_width, 2 * cascades.texel(0).x);
    const float most_hidden = 2 * widest / (glm::pi<float>() * radius);
    float darkest = 1, sum = 0;
    for (const float visibility : shadowed.visibilities()) {
      darkest = std::min(darkest, visibility);
      sum += visibility;
    }
    std::printf("%s: darkest pixel %.2f, hidden on average %.4f; texels of %.3f and %.3f m\n", technique.c_str(),
                darkest, 1 - sum / static_cast<float>(scene.width * scene.height), cascades.texel(0).x,
                cascades.texel(3).x);
    EXPECT_LT(darkest, 0.99) << technique << ": the wire has no shadow";
    EXPECT_GT(darkest, 1 - 5 * most_hidden) << technique;
  }
}

}  // namespace
}  // namespace penumbra::test

// What variance soft shadow maps promise where means and variances alone would fail.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

class Vssm : public TriangleTest {
 protected:
  Shadowed draw(const TriangleScene& scene, float angle, const std::string& technique = "vssm") {
    ParamSet params = renderer_->params();
    params.set("technique", technique);
    params.set("mask.tiles", false);  // so that the technique decides every pixel itself
    params.set("sun.angle", angle);
    params.set("cascades.count", 1);
    params.set("cascades.size", 512);
    return renderer_->render(scene, params);
  }
};

// A ground seen from above, and casters whose shadows fall elsewhere: so that the maps' depths reach far.
TriangleScene ground(float elevation) {
  TriangleScene scene;
  scene.add_quad({-20, 0, -20}, {0, 0, 40}, {40, 0, 0});
  scene.to_light = sun_direction(70, elevation);
  scene.view = glm::lookAt(glm::vec3(0, 8, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(3, 3, 0.1f, 10);
  return scene;
}

TEST_F(Vssm, UnshadowedPlanesAreFullyLitHoweverTilted) {
  for (const float elevation : {15.0f, 30.0f, 60.0f, 90.0f}) {
    for (const float angle : {0.53f, 2.0f, 8.0f}) {
      TriangleScene scene = ground(elevation);
      scene.add_box({-18, 0, -18}, {-17, 5, -17});
      for (const float visibility : draw(scene, angle).visibilities())
        ASSERT_EQ(visibility, 1) << "elevation " << elevation << ", sun of " << angle << " degrees";
    }
  }
}

// Kernels that reach a caster's edge, though the light does not: there the plane is told from blockers by its moments.
TEST_F(Vssm, TiltedPlanesBesideAPenumbraAreLit) {
  for (const float elevation : {30.0f, 60.0f, 90.0f}) {
    for (const float angle : {2.0f, 8.0f}) {
      TriangleScene scene = ground(elevation);
      scene.add_box({-0.5f, 4, -0.5f}, {0.5f, 5, 0.5f});
      scene.view = glm::lookAt(glm::vec3(0, 3, 0), glm::vec3(0), glm::vec3(0, 0, -1));
      scene.projection = orthographic(12, 12, 0.1f, 10);
      const Shadowed vssm = draw(scene, angle);
      const Shadowed larger = draw(scene, 1.6f * angle, "brute_force");
      int beside = 0;
      for (size_t i = 0; i < vssm.mask.size(); i += 4) {
        if (larger.mask[i] < 1) continue;
        ++beside;
        ASSERT_GE(vssm.mask[i], 0.999f) << "elevation " << elevation << ", sun of " << angle << " degrees, pixel "
                                        << i / 4;
      }
      EXPECT_LT(beside, vssm.width * vssm.height) << "no shadow in the picture";
      EXPECT_GT(beside, 500) << "nothing else in the picture";
    }
  }
}

// Roofs at two heights: their depths vary within a kernel, for which Chebyshev's inequality alone lets light through.
TEST_F(Vssm, UnderRoofsAtTwoHeightsItIsDark) {
  for (const float elevation : {60.0f, 90.0f}) {
    for (const float angle : {0.53f, 2.0f, 8.0f}) {
      TriangleScene scene = ground(elevation);
      const glm::vec3 beside = scene.to_light / scene.to_light.y;
      const glm::vec3 low = 10.0f * beside, high = 15.0f * beside;
      scene.add_quad({low.x - 15, 10, low.z - 15}, {0, 0, 30}, {15.5f, 0, 0});
      scene.add_quad({high.x, 15, high.z - 15}, {0, 0, 30}, {15, 0, 0});
      for (const float visibility : draw(scene, angle).visibilities())
        ASSERT_EQ(visibility, 0) << "elevation " << elevation << ", sun of " << angle << " degrees";
    }
  }
}

// Where all points of a kernel are hidden, rounding of their mean must not make visibility negative.
TEST_F(Vssm, VisibilityIsFromZeroToOne) {
  for (const float elevation : {30.0f, 50.0f, 70.0f}) {
    TriangleScene scene = ground(elevation);
    for (int i = 0; i < 5; ++i) {
      const float x = -6 + 2.5f * static_cast<float>(i), height = 3.2f + 0.3f * static_cast<float>(i);
      scene.add_box({x, height, -4}, {x + 2, height + 0.1f, 4});
    }
    scene.view = glm::lookAt(glm::vec3(0, 3, 0), glm::vec3(0), glm::vec3(0, 0, -1));
    scene.projection = orthographic(10, 10, 0.1f, 10);
    scene.width = scene.height = 128;
    const std::vector<float> visibilities = draw(scene, 3).visibilities();
    const auto [least, greatest] = std::ranges::minmax(visibilities);
    EXPECT_GE(least, 0) << "elevation " << elevation;
    EXPECT_LE(greatest, 1) << "elevation " << elevation;
    EXPECT_LT(least, 0.001f) << "no umbra in the picture";
  }
}

}  // namespace
}  // namespace penumbra::test

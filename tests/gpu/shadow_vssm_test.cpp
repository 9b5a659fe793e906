// What variance soft shadow maps promise where means and variances alone would fail.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gpu/exact_penumbra.h"
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

// Below the line where two roofs meet, at heights of 10 and 20 m, the light's cone is twice as wide at the higher one.
// A cone's edge crosses parts of the kernel of which a share is taken, hence the tolerance.
TEST_F(Vssm, TheMeanHeightIsThatOfBlockersWithinTheCone) {
  TriangleScene scene = ground(90);
  scene.add_quad({-15, 10, -15}, {0, 0, 30}, {15, 0, 0});
  scene.add_quad({0, 20, -15}, {0, 0, 30}, {15, 0, 0});
  scene.projection = orthographic(3, 0.4f, 0.1f, 10);
  scene.height = 8;
  const Shadowed shadowed = draw(scene, 8);
  const double slope = std::tan(glm::radians(4.0));
  for (int x = 0; x < shadowed.width; ++x) {
    const double place = shadowed.point(x, 3).x / slope;  // of discs as large as their height
    const double low = 100 * exact_disc(-place / 10), high = 400 * exact_disc(place / 20);
    const double mean = shadowed.mask[4 * static_cast<size_t>(3 * shadowed.width + x) + 2];
    EXPECT_NEAR(mean, (10 * low + 20 * high) / (low + high), 2) << place;
  }
}

// Half-planes at 5 m, under suns for which the ground is a tilted plane.
TEST_F(Vssm, PenumbraeOfObliqueSunsAreNearTheExactFunction) {
  for (const float elevation : {30.0f, 60.0f}) {
    for (const auto& [angle, most] : {std::pair(2.0f, 0.04), {8.0f, 0.065}}) {
      for (const float azimuth : {0.0f, 45.0f, 90.0f}) {
        const double height = 5, slope = std::tan(glm::radians(static_cast<double>(angle)) / 2);
        TriangleScene scene = ground(elevation);
        scene.to_light = sun_direction(azimuth, elevation);
        const auto middle = static_cast<float>(-height * scene.to_light.x / scene.to_light.y);
        const auto reach = static_cast<float>(1.6 * height * slope / (scene.to_light.y * scene.to_light.y));
        scene.add_quad({-60, 5, -60}, {0, 0, 120}, {60, 0, 0});
        scene.receivers = shadow::Box{{middle - reach, 0, -reach}, {middle + reach, 0, reach}};
        scene.width = 128;
        scene.height = 4;
        scene.view = glm::lookAt(glm::vec3(middle, 2.5f, 0), glm::vec3(middle, 0, 0), glm::vec3(0, 0, -1));
        scene.projection = orthographic(reach, reach * 4 / 128, 0.1f, 4);
        const Shadowed shadowed = draw(scene, angle);
        double worst = 0;
        for (int x = 0; x < shadowed.width; ++x) {
          const double exact = exact_oblique(glm::dvec3(scene.to_light), shadowed.point(x, 2).x, height, slope);
          worst = std::max(worst, std::abs(shadowed.visibility(x, 2) - exact));
        }
        EXPECT_LE(worst, most) << "sun of " << angle << " degrees at " << elevation << ", " << azimuth
                               << " to the edge";
      }
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

// Bias: no acne on lit planes, no gaps at contacts, and the same result with both drivers and with a very small sun.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "gpu/triangle_scene.h"
#include "support/alike.h"

namespace penumbra::test {
namespace {

using ShadowBias = TriangleTest;

// A plane of 40 m, seen from near its edge towards its middle, and optionally tilted about an oblique axis.
TriangleScene lone_plane(bool tilted) {
  TriangleScene scene;
  const glm::mat4 turn =
      tilted ? glm::rotate(glm::mat4(1), glm::radians(17.0f), glm::normalize(glm::vec3(1, 0.2f, 0.6f))) : glm::mat4(1);
  const glm::vec3 u(turn * glm::vec4(40, 0, 0, 0));
  const glm::vec3 v(turn * glm::vec4(0, 0, -40, 0));
  scene.add_quad(-0.5f * (u + v), u, v);
  scene.width = 160;
  scene.height = 90;
  scene.view = glm::lookAt(glm::vec3(2, 4, 15), glm::vec3(0, 0, -4), glm::vec3(0, 1, 0));
  scene.projection = perspective(glm::radians(50.0f), 16.0f / 9.0f, 0.1f);
  return scene;
}

glm::vec3 plane_normal(const TriangleScene& scene) {
  const Triangle& t = scene.triangles.front();
  return glm::normalize(glm::cross(t.b - t.a, t.c - t.a));
}

TEST_F(ShadowBias, LitPlanesDoNotShadowThemselves) {
  for (const bool tilted : {false, true}) {
    for (const float elevation : {1.0f, 10.0f, 30.0f, 60.0f, 90.0f}) {
      for (const float angle : {0.0f, 0.53f, 2.0f, 8.0f}) {
        for (const std::string technique : {"hard", "pcf", "pcf_hardware", "pcf_tent", "pcf_poisson", "pcss", "slices",
                                            "backprojection", "ssss", "vssm", "brute_force"}) {
          TriangleScene scene = lone_plane(tilted);
          scene.to_light = sun_direction(35, elevation);
          if (glm::dot(plane_normal(scene), scene.to_light) <= std::sin(glm::radians(angle) / 2)) continue;
          ParamSet params = renderer_->params();
          params.set("technique", technique);
          params.set("sun.angle", angle);
          params.set("cascades.size", 1024);
          const Shadowed shadowed = renderer_->render(scene, params);
          int lit = 0;
          int dark = 0;
          for (int y = 0; y < scene.height; ++y) {
            for (int x = 0; x < scene.width; ++x) {
              if (shadowed.sky(x, y)) continue;
              ++lit;
              if (shadowed.visibility(x, y) < 0.99f) ++dark;
            }
          }
          ASSERT_GT(lit, 5000);
          EXPECT_LE(dark, lit / 1000) << technique << ", sun of " << angle << " degrees at " << elevation
                                      << " degrees, " << (tilted ? "tilted" : "level") << " plane";
        }
      }
    }
  }
}

// Rasterisers round vertices to a grid, and some interpolate depth between the rounded ones: what they draw at a
// pixel's centre is what lies up to half a step of the grid beside it. The renderer of this test may be another kind.
TEST_F(ShadowBias, RoundedVerticesDoNotShadowThePlane) {
  constexpr float half_step = 0.5f / 256;
  renderer_->device().assume_vertex_rounding(half_step);
  for (const std::string technique :
       {"hard", "pcf_hardware", "pcss", "slices", "backprojection", "ssss", "vssm", "brute_force", "shadow_volume"}) {
    for (const float elevation : {1.0f, 30.0f}) {
      for (const glm::vec2& way : {glm::vec2(1, 1), {1, -1}, {-1, 1}, {-1, -1}}) {
        TriangleScene scene = lone_plane(/*tilted=*/false);
        scene.to_light = sun_direction(35, elevation);
        scene.drawn_beside = half_step * way;
        ParamSet params = renderer_->params();
        params.set("technique", technique);
        params.set("sun.angle", 0.53f);
        const Shadowed shadowed = renderer_->render(scene, params);
        int lit = 0, dark = 0;
        for (int y = 0; y < scene.height; ++y) {
          for (int x = 0; x < scene.width; ++x) {
            lit += shadowed.sky(x, y) ? 0 : 1;
            dark += !shadowed.sky(x, y) && shadowed.visibility(x, y) < 0.99f ? 1 : 0;
          }
        }
        ASSERT_GT(lit, 5000);
        EXPECT_LE(dark, lit / 1000) << technique << ", sun at " << elevation << " degrees, " << way.x << ", " << way.y;
      }
    }
  }
}

// The gap between a wall and its shadow: how far from the wall's foot the ground is lit on the side away from the sun,
// in texels of the map as the light projects them onto the ground.
double gap_in_texels(TriangleRenderer& renderer, const std::string& technique, float elevation, float height) {
  TriangleScene scene;
  scene.add_quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20});
  scene.add_quad({1, 0, 1}, {0, 0, -2}, {0, height, 0});
  scene.to_light = sun_direction(270, elevation);  // from -X: the shadow falls on +X
  scene.width = 512;
  scene.height = 8;
  scene.view = glm::lookAt(glm::vec3(1.1f, 8, 0), glm::vec3(1.1f, 0, 0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(0.15f, 0.01f, 0.1f, 20);
  ParamSet params = renderer.params();
  params.set("technique", technique);
  const Shadowed shadowed = renderer.render(scene, params);
  const float texel = renderer.mask().lights[0].projection.cascades().texel(0).x;
  const double sun = glm::radians(static_cast<double>(elevation));
  const double on_ground = texel / std::sin(sun);
  const double shadow_length = height / std::tan(sun);
  double gap = 0;
  for (int x = 0; x < scene.width; ++x) {
    const glm::vec3& p = shadowed.point(x, scene.height / 2);
    if (p.x <= 1 || p.y > 0.01f) continue;
    if (shadowed.visibility(x, scene.height / 2) > 0.5f) gap = std::max(gap, static_cast<double>(p.x) - 1);
    if (p.x > 1 + std::min(8 * on_ground, 0.75 * shadow_length)) break;
  }
  return gap / on_ground;
}

TEST_F(ShadowBias, ContactShadowsStartAtTheContact) {
  for (const std::string technique : {"hard", "pcss", "slices", "backprojection", "ssss", "vssm", "brute_force"}) {
    for (const float elevation : {10.0f, 30.0f, 60.0f}) {
      for (const float height : {0.1f, 0.3f, 1.5f}) {
        EXPECT_LE(gap_in_texels(*renderer_, technique, elevation, height), 2)
            << technique << ", sun at " << elevation << " degrees, a wall of " << height
            << " m: a lit gap at its foot, in texels";
      }
    }
  }
}

// A wall on the ground, both lit, seen so close that a texel of the map covers several pixels.
TriangleScene lit_crease(float azimuth, float elevation) {
  TriangleScene scene;
  scene.add_quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20});
  scene.add_quad({0, 0, 3}, {0, 0, -6}, {0, 3, 0});  // faces -X
  scene.to_light = sun_direction(azimuth, elevation);
  scene.width = 192;
  scene.height = 128;
  scene.view = glm::lookAt(glm::vec3(-3, 2, 1), glm::vec3(0, 0, 0), glm::vec3(0, 1, 0));
  scene.projection = orthographic(0.24f, 0.16f, 0.1f, 20);
  return scene;
}

TEST_F(ShadowBias, LitFacesDoNotShadowEachOtherWhereTheyMeet) {
  for (const std::string technique :
       {"hard", "pcss", "slices", "backprojection", "ssss", "vssm", "brute_force", "every texel"}) {
    for (const float azimuth : {270.0f, 310.0f, 200.0f}) {
      for (const float elevation : {10.0f, 35.0f, 60.0f, 80.0f}) {
        const TriangleScene scene = lit_crease(azimuth, elevation);
        ParamSet params = renderer_->params();
        params.set("technique", technique == "every texel" ? std::string("brute_force") : technique);
        params.set("brute_force.every_texel", technique == "every texel");
        const Shadowed shadowed = renderer_->render(scene, params);
        int dark = 0;
        for (int y = 0; y < scene.height; ++y) {
          for (int x = 0; x < scene.width; ++x) dark += shadowed.visibility(x, y) < 0.99f ? 1 : 0;
        }
        EXPECT_LE(dark, scene.width * scene.height / 1000)
            << technique << ", sun at " << azimuth << ", " << elevation << " degrees";
      }
    }
  }
}

// Boxes of several heights on a ground, under a low sun.
TriangleScene boxes() {
  TriangleScene scene;
  scene.add_quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  for (int i = 0; i < 7; ++i) {
    const float x = -6 + 2 * static_cast<float>(i);
    scene.add_box({x, 0, -2 - x * 0.3f}, {x + 0.6f, 0.4f + 0.5f * static_cast<float>(i), -1 - x * 0.3f});
  }
  scene.to_light = sun_direction(60, 35);
  scene.width = 160;
  scene.height = 90;
  scene.view = glm::lookAt(glm::vec3(1, 3, 8), glm::vec3(0, 0.5f, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(glm::radians(55.0f), 16.0f / 9.0f, 0.1f);
  return scene;
}

TEST_F(ShadowBias, FragmentAndComputeGiveTheSameMask) {
  for (const std::string technique : {"none", "hard", "pcf", "pcf_hardware", "pcf_tent", "pcf_poisson", "pcss",
                                      "slices", "backprojection", "ssss", "vssm", "brute_force"}) {
    for (const std::string shape : {"disc", "square"}) {
      ParamSet params = renderer_->params();
      params.set("technique", technique);
      params.set("sun.shape", shape);
      params.set("sun.angle", 2.0f);
      const Shadowed fragment = renderer_->render(boxes(), params);
      params.set("driver", std::string("compute"));
      const Shadowed compute = renderer_->render(boxes(), params);
      SCOPED_TRACE(technique);
      SCOPED_TRACE(shape);
      expect_same_visibility(fragment.visibilities(), compute.visibilities(), 16);
      if (gl::device_info().software) {
        EXPECT_EQ(fragment.mask, compute.mask);
      }
    }
  }
}

double mean_difference(const Shadowed& a, const Shadowed& b) {
  double sum = 0;
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) sum += std::abs(a.visibility(x, y) - b.visibility(x, y));
  }
  return sum / (a.width * a.height);
}

TEST_F(ShadowBias, SoftShadowsTendToHardOnesAsTheSunShrinks) {
  ParamSet params = renderer_->params();
  params.set("technique", std::string("hard"));
  const auto soft = [&](float angle) {
    ParamSet with_angle = renderer_->params();
    with_angle.set("sun.angle", angle);
    return renderer_->render(boxes(), with_angle);
  };
  params.set("sun.angle", 0.0f);
  const Shadowed hard = renderer_->render(boxes(), params);
  EXPECT_EQ(mean_difference(soft(0), hard), 0);
  params.set("technique", std::string("slices"));
  // Filtered texels have smoother outlines.
  EXPECT_LE(mean_difference(renderer_->render(boxes(), params), hard), 0.002);
  params.set("slices.filter_radius", 0);
  EXPECT_EQ(mean_difference(renderer_->render(boxes(), params), hard), 0);
  params.set("technique", std::string("brute_force"));
  params.set("brute_force.every_texel", true);
  EXPECT_EQ(mean_difference(renderer_->render(boxes(), params), hard), 0);
  const double at_1 = mean_difference(soft(1), hard);
  const double at_01 = mean_difference(soft(0.1f), hard);
  const double at_001 = mean_difference(soft(0.01f), hard);
  EXPECT_GT(at_1, at_01);
  EXPECT_GT(at_01, at_001);
  EXPECT_GT(at_001, 0);
}

}  // namespace
}  // namespace penumbra::test

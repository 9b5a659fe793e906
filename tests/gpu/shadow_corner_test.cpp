// Hard shadows compared with rays where faces meet: lit corners must not be dark, and shadows that fall into corners
// must not be missing.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/exact_penumbra.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

using ShadowCorner = TriangleTest;

// Adds a box of that size; `place` transforms it, with the origin at the centre of its base.
void add_turned_box(TriangleScene& scene, const glm::vec3& size, const glm::mat4& place) {
  TriangleScene box;
  box.add_box({-size.x / 2, 0, -size.z / 2}, {size.x / 2, size.y, size.z / 2});
  for (const Triangle& t : box.triangles) {
    const auto moved = [&](const glm::vec3& p) { return glm::vec3(place * glm::vec4(p, 1)); };
    scene.triangles.push_back({moved(t.a), moved(t.b), moved(t.c)});
  }
}

glm::mat4 placed(const glm::vec3& at, float yaw_degrees, float lean_degrees = 0) {
  const glm::mat4 yaw = glm::rotate(glm::translate(glm::mat4(1), at), glm::radians(yaw_degrees), glm::vec3(0, 1, 0));
  return glm::rotate(yaw, glm::radians(lean_degrees), glm::vec3(0, 0, 1));
}

struct NamedScene {
  std::string name;
  TriangleScene scene;
};

// On a ground of 12 m: walls in a corner, a wall turned by 45 degrees under a floating slab, stairs, a fence, a plank
// that leans on a wall, low kerbs.
std::vector<NamedScene> corner_scenes() {
  std::vector<NamedScene> scenes{{"two walls", {}}, {"wall under a slab", {}}, {"stairs", {}},
                                 {"fence", {}},     {"leaning plank", {}},     {"kerbs", {}}};
  for (NamedScene& named : scenes) named.scene.add_quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -12});
  add_turned_box(scenes[0].scene, {0.3f, 2, 3}, placed({0.5f, 0, 0}, 0));
  add_turned_box(scenes[0].scene, {3, 2, 0.3f}, placed({-1, 0, -1.4f}, 0));
  add_turned_box(scenes[1].scene, {0.3f, 1.5f, 3}, placed({0.5f, 0, 0}, 45));
  add_turned_box(scenes[1].scene, {1, 0.1f, 1}, placed({-0.3f, 1.2f, 0.8f}, 10));
  for (int i = 0; i < 8; ++i) {
    const float x = 0.25f * static_cast<float>(i);
    add_turned_box(scenes[2].scene, {0.25f, 0.15f * static_cast<float>(i + 1), 2}, placed({x - 1, 0, 0}, 0));
  }
  for (int i = 0; i < 12; ++i) {
    const float x = 0.2f * static_cast<float>(i);
    add_turned_box(scenes[3].scene, {0.06f, 0.5f + 0.1f * static_cast<float>(i % 5), 0.06f}, placed({x - 1, 0, 0}, 20));
  }
  add_turned_box(scenes[4].scene, {0.2f, 1.5f, 2}, placed({0.8f, 0, 0}, 0));
  add_turned_box(scenes[4].scene, {0.08f, 1.6f, 0.4f}, placed({0.1f, 0, 0.2f}, 0, -20));
  for (int i = 0; i < 4; ++i) {
    add_turned_box(scenes[5].scene, {0.3f, 0.08f * static_cast<float>(i + 1), 1},
                   placed({static_cast<float>(i) * 0.7f - 1, 0, 0}, 15));
  }
  for (NamedScene& named : scenes) {
    named.scene.width = 320;
    named.scene.height = 180;
    named.scene.view = glm::lookAt(glm::vec3(-2.5f, 2.2f, 3), glm::vec3(0, 0.3f, 0), glm::vec3(0, 1, 0));
    named.scene.projection = perspective(glm::radians(45.0f), 16.0f / 9.0f, 0.1f);
  }
  return scenes;
}

// Möller and Trumbore 1997.
bool hits(const glm::dvec3& from, const glm::dvec3& direction, const Triangle& triangle) {
  const glm::dvec3 a(triangle.a);
  const glm::dvec3 edge = glm::dvec3(triangle.b) - a;
  const glm::dvec3 other = glm::dvec3(triangle.c) - a;
  const glm::dvec3 p = glm::cross(direction, other);
  const double determinant = glm::dot(edge, p);
  if (std::abs(determinant) < 1e-14) return false;
  const glm::dvec3 s = from - a;
  const double u = glm::dot(s, p) / determinant;
  const glm::dvec3 q = glm::cross(s, edge);
  const double v = glm::dot(direction, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(other, q) / determinant > 0;
}

// Whether the light reaches each pixel, from a millimetre above it.
std::vector<int> lit_by_rays(const TriangleScene& scene, const Shadowed& shadowed) {
  const glm::dvec3 to_light(scene.to_light);
  std::vector<int> lit;
  for (int i = 0; i < scene.width * scene.height; ++i) {
    const glm::dvec3 from = glm::dvec3(shadowed.points[static_cast<size_t>(i)]) + 0.001 * to_light;
    bool free = true;
    for (const Triangle& triangle : scene.triangles) free = free && !hits(from, to_light, triangle);
    lit.push_back(free ? 1 : 0);
  }
  return lit;
}

struct Wrong {
  int dark = 0, lit = 0, all = 0;  // pixels
};

// Pixels that are wrong though all rays within `reach` pixels of them agree: away from the edges of shadows, whose
// exact place depends on the map's texels.
Wrong compare(const TriangleScene& scene, const Shadowed& shadowed) {
  constexpr int reach = 4;
  const std::vector<int> lit = lit_by_rays(scene, shadowed);
  Wrong wrong;
  for (int y = reach; y < scene.height - reach; ++y) {
    for (int x = reach; x < scene.width - reach; ++x) {
      bool sure = true;
      const int here = lit[static_cast<size_t>(y * scene.width + x)];
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          sure = sure && !shadowed.sky(x + dx, y + dy) &&
                 lit[static_cast<size_t>((y + dy) * scene.width + x + dx)] == here;
        }
      }
      if (!sure) continue;
      ++wrong.all;
      wrong.dark += here == 1 && shadowed.visibility(x, y) < 0.9f ? 1 : 0;
      wrong.lit += here == 0 && shadowed.visibility(x, y) > 0.1f ? 1 : 0;
    }
  }
  return wrong;
}

TEST_F(ShadowCorner, HardShadowsAgreeWithRaysWhereFacesMeet) {
  for (NamedScene& named : corner_scenes()) {
    for (const float azimuth : {285.0f, 320.0f, 30.0f, 120.0f}) {
      for (const float elevation : {20.0f, 45.0f, 75.0f}) {
        named.scene.to_light = sun_direction(azimuth, elevation);
        ParamSet params = renderer_->params();
        params.set("technique", std::string("hard"));
        params.set("cascades.size", 1024);
        const Wrong wrong = compare(named.scene, renderer_->render(named.scene, params));
        ASSERT_GT(wrong.all, 10000);
        const std::string sun = fmt::format("{}, sun at {}, {} degrees", named.name, azimuth, elevation);
        EXPECT_LE(wrong.dark, wrong.all / 1000) << sun << ": lit pixels are dark";
        EXPECT_LE(wrong.lit, wrong.all / 1000) << sun << ": shadowed pixels are lit";
      }
    }
  }
}

TEST_F(ShadowCorner, HardShadowsDoNotDependOnTheSunsAngle) {
  for (NamedScene& named : corner_scenes()) {
    named.scene.to_light = sun_direction(285, 45);
    ParamSet params = renderer_->params();
    params.set("technique", std::string("hard"));
    const Shadowed narrow = renderer_->render(named.scene, params);
    // The caller's maps would be the same; the library's own grow with the light's cone.
    params.set("sun.angle", 0.6f);
    const Shadowed wide = renderer_->render(named.scene, params);
    int differ = 0;
    for (size_t i = 0; i < narrow.mask.size(); i += 4) differ += std::abs(narrow.mask[i] - wide.mask[i]) > 0.5f ? 1 : 0;
    EXPECT_LE(differ, 320 * 180 / 1000) << named.name;
  }
}

// A ground that meets a face at x = 0, which rises by so much per metre to a height of 2 m, under a sun at the zenith.
Shadowed below_a_face(TriangleRenderer& renderer, float rise) {
  TriangleScene scene;
  scene.add_quad({-2, 0, -2}, {0, 0, 4}, {2, 0, 0});
  scene.add_quad({0, 0, -2}, {0, 0, 4}, {2 / rise, 2, 0});
  scene.width = 128;
  scene.height = 16;
  scene.view = glm::lookAt(glm::vec3(-0.1f, 1, 0), glm::vec3(-0.1f, 0, 0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(0.1f, 0.1f * 16 / 128, 0.1f, 2);
  ParamSet params = renderer.params();
  params.set("technique", std::string("slices"));
  params.set("sun.angle", 8.0f);
  params.set("cascades.count", 1);
  params.set("cascades.size", 256);
  params.set("slices.azimuths", 32);
  params.set("slices.samples", 32);
  return renderer.render(scene, params);
}

// Whether a face hides a part of the light: only if it is steeper than the light's cone, which rises by 14.3 m per
// metre.
TEST_F(ShadowCorner, FacesBesideAReceiverHideWhatTheyRiseAbove) {
  const double slope = std::tan(glm::radians(4.0));
  for (const float rise : {2.0f, 8.0f, 30.0f}) {
    const Shadowed shadowed = below_a_face(*renderer_, rise);
    for (int x = 0; x < shadowed.width; ++x) {
      double mean = 0;
      const double away = -shadowed.point(x, 8).x;
      if (away < 0.004) continue;  // a small part of a texel
      for (int y = 0; y < shadowed.height; ++y)
        mean += static_cast<double>(shadowed.visibility(x, y)) / shadowed.height;
      EXPECT_NEAR(mean, exact_disc((1.0 / rise + away / 2) / slope), 0.03) << rise << ", " << away << " m away";
    }
  }
}

// Hard shadows in a square of ground of 0.6 m, from straight above.
Shadowed hard_shadows(TriangleRenderer& renderer, TriangleScene scene, float camera) {
  scene.width = scene.height = 64;
  scene.view = glm::lookAt(glm::vec3(0, camera, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(0.3f, 0.3f, 0.001f, camera + 1);
  ParamSet params = renderer.params();
  params.set("technique", std::string("hard"));
  params.set("mask.tiles", false);
  params.set("cascades.count", 1);
  params.set("cascades.size", 64);
  return renderer.render(scene, params);
}

// A slab so low above the ground that, under a low sun, some of its texels lie deeper than the receivers below it.
TEST_F(ShadowCorner, LowSlabsHideWhatIsBelow) {
  TriangleScene ground;
  ground.add_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  for (const float azimuth : {0.0f, 30.0f, 45.0f}) {
    ground.to_light = sun_direction(azimuth, 25);
    hard_shadows(*renderer_, ground, 1);
    const float texel = renderer_->mask().lights[0].projection.cascades().texel(0).x;
    for (const float height : {0.5f, 1.0f, 2.0f, 3.0f, 4.0f}) {
      TriangleScene scene = ground;
      scene.add_quad({-2, height * texel, -2}, {0, 0, 4}, {4, 0, 0});
      int lit = 0;
      for (const float visibility : hard_shadows(*renderer_, scene, 0.5f * height * texel).visibilities())
        lit += visibility > 0 ? 1 : 0;
      EXPECT_EQ(lit, 0) << azimuth << ", " << height << " texels";
    }
  }
}

// Two faces rise from a strip of ground that is narrower than a texel, aslant in the map: around the strip all texels
// lie before it, but they do not show one surface, which would cover it. All is lit but for a few pixels.
TEST_F(ShadowCorner, GroovesNarrowerThanATexelAreLit) {
  int dark = 0;
  for (const float azimuth : {20.0f, 45.0f, 70.0f}) {
    for (const float elevation : {25.0f, 45.0f}) {
      for (const float rise : {0.25f, 0.4f}) {
        TriangleScene scene;
        scene.to_light = sun_direction(azimuth, elevation);
        scene.add_quad({-2, 0, 0.003f}, {4, 0, 0}, {0, 0, 0.006f});
        scene.add_quad({-2, 0, 0.009f}, {4, 0, 0}, {0, rise, 1});
        scene.add_quad({-2, 0, 0.003f}, {4, 0, 0}, {0, rise, -1});
        for (const float visibility : hard_shadows(*renderer_, scene, 3).visibilities()) dark += visibility < 1 ? 1 : 0;
      }
    }
  }
  EXPECT_LE(dark, 80) << "of 12 pictures, with 64 pixels of each groove";
}

}  // namespace
}  // namespace penumbra::test

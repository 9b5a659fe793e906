// The technique shadow_volume against closed forms, and against rays through the triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

// Points nearer to a surface than this, metres across it, lie on it: points come from depths. A rasteriser that rounds
// vertices to 1/256 of a pixel moves points of these scenes, whose pixels are at most 0.15 m wide, by up to 0.3 mm.
constexpr double on_surface = 5e-4;

// Where the line from a point towards the light meets the triangle: metres from the point, not a number if it does not.
double distance_to(const Triangle& triangle, const glm::dvec3& from, const glm::dvec3& to_light) {
  const glm::dvec3 u = glm::dvec3(triangle.b) - glm::dvec3(triangle.a);
  const glm::dvec3 v = glm::dvec3(triangle.c) - glm::dvec3(triangle.a);
  const glm::dvec3 across = glm::cross(to_light, v);
  const double determinant = glm::dot(u, across);
  const glm::dvec3 start = from - glm::dvec3(triangle.a);
  const glm::dvec3 turned = glm::cross(start, u);
  const double s = glm::dot(start, across) / determinant;
  const double t = glm::dot(to_light, turned) / determinant;
  return s >= 0 && t >= 0 && s + t <= 1 ? glm::dot(v, turned) / determinant : std::nan("");
}

// Whether the camera sees a point of a surface on the side that the sun lights, and nothing is between it and the sun.
bool lit(const TriangleScene& scene, const glm::dvec3& from) {
  const glm::dvec3 to_light(scene.to_light);
  const glm::dvec3 to_eye = glm::dvec3(glm::inverse(glm::dmat4(scene.view))[3]) - from;
  return std::ranges::none_of(scene.triangles, [&](const Triangle& triangle) {
    const double distance = distance_to(triangle, from, to_light);
    const glm::dvec3 normal(glm::normalize(glm::cross(triangle.b - triangle.a, triangle.c - triangle.a)));
    if (!(std::abs(distance * glm::dot(normal, to_light)) <= on_surface)) return distance > 0;
    return glm::dot(normal, to_light) * glm::dot(normal, to_eye) < 0;
  });
}

struct Comparison {
  int lit = 0, dark = 0, wrong = 0;  // pixels; edges are neither
};

// Compares pixels with rays. Where points within `tolerance` metres in x and z disagree there is an edge.
Comparison compare(const TriangleScene& scene, const Shadowed& shadowed, double tolerance = 2e-4) {
  Comparison result;
  for (int y = 0; y < shadowed.height; ++y) {
    for (int x = 0; x < shadowed.width; ++x) {
      if (shadowed.sky(x, y)) {
        result.wrong += shadowed.visibility(x, y) != 1 ? 1 : 0;
        continue;
      }
      const glm::dvec3 point(shadowed.point(x, y));
      const bool expected = lit(scene, point);
      const std::array<glm::dvec3, 4> around{glm::dvec3(1, 0, 0), {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
      const bool edge = std::ranges::any_of(
          around, [&](const glm::dvec3& way) { return lit(scene, point + tolerance * way) != expected; });
      if (edge) continue;
      ++(expected ? result.lit : result.dark);
      result.wrong += shadowed.visibility(x, y) != (expected ? 1 : 0) ? 1 : 0;
    }
  }
  return result;
}

// A ground of 10 m, the sun, and a camera that sees most of it from above.
TriangleScene ground(int side = 96) {
  TriangleScene scene;
  scene.add_quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  scene.view = glm::lookAt(glm::vec3(2, 5, 6), glm::vec3(0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.8f, 1, 0.1f);
  scene.width = scene.height = side;
  scene.to_light = sun_direction(60, 40);
  return scene;
}

class ShadowVolume : public TriangleTest {
 protected:
  void SetUp() override {
    TriangleTest::SetUp();
    params_ = renderer_->params();
    params_.set("technique", std::string("shadow_volume"));
  }
  Shadowed draw(const TriangleScene& scene, const TriangleRenderer::Adjust& adjust = {}) {
    return renderer_->render(scene, params_, adjust);
  }
  void expect_rays(const TriangleScene& scene, const std::string& what, int least_dark = 100) {
    const Comparison c = compare(scene, draw(scene));
    EXPECT_EQ(c.wrong, 0) << what;
    EXPECT_GE(c.dark, least_dark) << what;
    EXPECT_GE(c.lit, 100) << what;
  }

  ParamSet params_{std::vector<Param>{}};
};

// The square is 1 m above the ground, and the sun's rays descend 1 m over 1 m along x. It is moved in steps of an
// eighth of a pixel: the shadow's edges must pass the pixels' centres when they should.
TEST_F(ShadowVolume, ASquaresShadowIsExactToAFractionOfAPixel) {
  constexpr int side = 64;
  constexpr float pixel = 4.0f / side;
  for (int step = 0; step < 8; ++step) {
    const float moved = pixel * (0.0625f + 0.125f * static_cast<float>(step));
    TriangleScene scene;
    scene.add_quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
    scene.add_quad({0.5f + moved, 1, 0.5f + moved}, {1, 0, 0}, {0, 0, -1});
    scene.width = scene.height = side;
    scene.view = glm::lookAt(glm::vec3(0, 0.5f, 0), glm::vec3(0), glm::vec3(0, 0, -1));
    scene.projection = orthographic(2, 2, 0.05f, 5);
    scene.to_light = glm::normalize(glm::vec3(1, 1, 0));
    const Shadowed shadowed = draw(scene);
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const float at_x = -2 + pixel * (static_cast<float>(x) + 0.5f);
        const float at_z = 2 - pixel * (static_cast<float>(y) + 0.5f);
        const bool dark = at_x > -0.5f + moved && at_x < 0.5f + moved && at_z > -0.5f + moved && at_z < 0.5f + moved;
        ASSERT_EQ(shadowed.visibility(x, y), dark ? 0 : 1) << x << ", " << y << ", step " << step;
      }
    }
  }
}

// Strips 1 m above the ground, each a 600th of a pixel wide: less than the rasteriser's grid. The shadow of each falls
// on the centres of a column of pixels, and the camera looks along its sides.
TEST_F(ShadowVolume, StripsNarrowerThanTheRasterizersGridCastShadows) {
  constexpr int side = 64;
  constexpr float pixel = 4.0f / side, width = pixel / 600;
  TriangleScene scene;
  scene.add_quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  for (int x = 0; x < side; x += 2) {
    const float middle = -2 + pixel * (static_cast<float>(x) + 0.5f);
    scene.add_quad({middle - width / 2, 1, 1}, {width, 0, 0}, {0, 0, -2});
  }
  scene.width = scene.height = side;
  scene.view = glm::lookAt(glm::vec3(0, 0.5f, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(2, 2, 0.05f, 5);
  scene.to_light = {0, 1, 0};
  const Shadowed shadowed = draw(scene);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const bool dark = x % 2 == 0 && y >= side / 4 && y < 3 * side / 4;
      EXPECT_EQ(shadowed.visibility(x, y), dark ? 0 : 1) << x << ", " << y;
    }
  }
}

TEST_F(ShadowVolume, BoxesAndWhatFacesAwayAgreeWithRays) {
  for (const float elevation : {10.0f, 40.0f, 75.0f}) {
    for (const float azimuth : {20.0f, 110.0f, 200.0f, 290.0f}) {
      TriangleScene scene = box_on_ground(96);
      scene.add_box({1.5f, 2.5f, -0.4f}, {1.9f, 2.9f, 0.3f});
      scene.to_light = sun_direction(azimuth, elevation);
      expect_rays(scene, std::to_string(azimuth) + ", " + std::to_string(elevation), azimuth < 90 ? 0 : 200);
    }
  }
}

// The eye is in the shadow of a roof and of a box on it.
TriangleScene below_a_roof(const glm::vec3& eye) {
  TriangleScene scene = ground();
  scene.add_box({-1, 1.5f, -1}, {1, 1.55f, 1});
  scene.add_box({-0.2f, 1.6f, -0.2f}, {0.2f, 2, 0.2f});
  scene.to_light = sun_direction(80, 60);
  scene.view = glm::lookAt(eye, glm::vec3(-3, 0, 1), glm::vec3(0, 1, 0));
  scene.projection = perspective(1.2f, 1, 0.1f);
  return scene;
}

TEST_F(ShadowVolume, TheCameraMayBeInsideVolumes) {
  for (const glm::vec3 eye : {glm::vec3(-0.4f, 0.6f, 0.1f), {0, 1.2f, 0}, {-0.9f, 0.2f, -0.3f}}) {
    const TriangleScene scene = below_a_roof(eye);
    ASSERT_FALSE(lit(scene, eye));
    expect_rays(scene, "inside, eye at x = " + std::to_string(eye.x));
  }
}

TEST_F(ShadowVolume, TheCameraMayLookTowardsTheSun) {
  TriangleScene scene = ground();
  scene.add_quad({-1, 0.3f, -3}, {2, 0, 0}, {0, 1.5f, 0});
  scene.to_light = sun_direction(180, 25);
  scene.view = glm::lookAt(glm::vec3(0, 1, 4), glm::vec3(0, 0, -3), glm::vec3(0, 1, 0));
  const Comparison c = compare(scene, draw(scene));
  EXPECT_GE(c.dark, 100);
  EXPECT_EQ(c.wrong, 0);
}

TEST_F(ShadowVolume, OpenMeshesCastFromBothSides) {
  TriangleScene scene = ground();
  scene.triangles.push_back({{-1, 1, 1}, {1, 1.4f, 0.8f}, {0.2f, 0.8f, -1}});  // alone
  for (int i = 0; i < 8; ++i) {                                                // a strip that winds about an axis
    const auto at = [&](int k, float side) {
      const float angle = 0.5f * static_cast<float>(k);
      return glm::vec3(-2 + 0.4f * static_cast<float>(k), 1.2f, -1.5f) +
             0.3f * side * glm::vec3(0, std::sin(angle), std::cos(angle));
    };
    scene.triangles.push_back({at(i, -1), at(i + 1, -1), at(i, 1)});
    scene.triangles.push_back({at(i, 1), at(i + 1, -1), at(i + 1, 1)});
  }
  expect_rays(scene, "front");
  for (Triangle& triangle : scene.triangles) std::swap(triangle.b, triangle.c);
  expect_rays(scene, "turned over");
}

// Around the centre triangles are much narrower than the rasteriser's grid: the shadow has no holes there.
TEST_F(ShadowVolume, AFanOfSliversCastsAShadowWithoutHoles) {
  TriangleScene scene;
  scene.add_quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20});
  scene.width = 640;
  scene.height = 360;
  scene.view = glm::lookAt(glm::vec3(2, 3, 9), glm::vec3(0, 0.5f, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.785f, 640.0f / 360, 0.1f);
  scene.to_light = sun_direction(170, 25);
  constexpr int count = 2000;
  const glm::vec3 centre(0, 2, 0);
  const auto rim = [](int i) {
    const double angle = 2 * glm::pi<double>() * (i % count) / count;
    return glm::vec3(3 * std::cos(angle), 2 + 0.2 * std::sin(7 * angle), 3 * std::sin(angle));
  };
  for (int i = 0; i < count; ++i) scene.triangles.push_back({centre, rim(i), rim(i + 1)});
  const Shadowed shadowed = draw(scene);
  const glm::vec3 middle = centre - scene.to_light * (centre.y / scene.to_light.y);
  int seen = 0, lit_pixels = 0;
  for (int y = 0; y < shadowed.height; ++y) {
    for (int x = 0; x < shadowed.width; ++x) {
      if (shadowed.sky(x, y) || glm::distance(shadowed.point(x, y), middle) > 1) continue;
      ++seen;
      lit_pixels += shadowed.visibility(x, y) > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 1000);
  EXPECT_EQ(lit_pixels, 0);
}

// Over each pixel's centre two triangles meet, as near as floats can tell. Their common edge has its ends in the same
// order, in the opposite one, or is another one of the three.
TEST_F(ShadowVolume, EdgesAboveCentresOfPixelsLeaveNoGap) {
  constexpr int side = 32;
  constexpr float pixel = 4.0f / side;
  TriangleScene scene;
  scene.add_quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4});
  for (int i = 0; i < side * side; ++i) {
    const int row = i / side;
    const glm::vec3 centre(-2 + pixel * (static_cast<float>(i % side) + 0.5f), 1,
                           2 - pixel * (static_cast<float>(row) + 0.5f));
    const float angle = 2.4f * static_cast<float>(i);
    const glm::vec3 along = pixel * glm::vec3(std::cos(angle), 0, std::sin(angle));
    const glm::vec3 across(-along.z, 0, along.x);
    const glm::vec3 from = centre - 0.3f * along, to = centre + 0.37f * along;
    scene.triangles.push_back({from, to, centre + 0.4f * across});
    const glm::vec3 other = centre - 0.35f * across;
    scene.triangles.push_back(i % 3 == 0   ? Triangle{from, to, other}
                              : i % 3 == 1 ? Triangle{to, from, other}
                                           : Triangle{to, other, from});
  }
  scene.width = scene.height = side;
  scene.view = glm::lookAt(glm::vec3(0, 0.5f, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(2, 2, 0.05f, 5);
  scene.to_light = {0, 1, 0};
  const Shadowed shadowed = draw(scene);
  int lit_pixels = 0;
  for (const float visibility : shadowed.visibilities()) lit_pixels += visibility > 0 ? 1 : 0;
  EXPECT_EQ(lit_pixels, 0);
}

// A lamp 1 cm behind a wall: what its rays cross nearer than lamps.near does not shadow, however large the triangle is.
TEST_F(ShadowVolume, WhatIsNearerToALampThanItsNearPlaneCastsNoShadow) {
  TriangleScene scene = ground();
  scene.add_quad({-3, 0, 0}, {6, 0, 0}, {0, 3, 0});
  scene.view = glm::lookAt(glm::vec3(0, 4, 8), glm::vec3(0), glm::vec3(0, 1, 0));
  params_.set("lamps.near", 0.02f);
  const shadow::Light lamp{.source = shadow::Lamp{.position = {0, 1, -0.01f}}};
  const Shadowed shadowed = draw(scene, [&](shadow::Inputs& inputs) { inputs.lights = {&lamp, 1}; });
  int lit_pixels = 0, dark_pixels = 0, wrong = 0;
  for (int y = 0; y < shadowed.height; ++y) {
    for (int x = 0; x < shadowed.width; ++x) {
      const glm::vec3 point = shadowed.point(x, y);
      if (shadowed.sky(x, y) || point.y > 1e-3f || point.z < 0.1f) continue;
      const float crossed = 0.01f * glm::distance(point, glm::vec3(0, 1, -0.01f)) / (point.z + 0.01f);  // from the lamp
      if (std::abs(crossed - 0.02f) < 2e-4f) continue;
      ++(crossed < 0.02f ? lit_pixels : dark_pixels);
      wrong += (shadowed.visibility(x, y) > 0) != (crossed < 0.02f) ? 1 : 0;
    }
  }
  EXPECT_GT(lit_pixels, 500);
  EXPECT_GT(dark_pixels, 100);
  EXPECT_EQ(wrong, 0);
}

TEST_F(ShadowVolume, ThreeTrianglesMayShareAnEdge) {
  TriangleScene scene = ground();
  const glm::vec3 low(-0.5f, 1, 0.7f), high(0.4f, 1.6f, -0.6f);
  for (const glm::vec3 third : {glm::vec3(-1.2f, 1.1f, -0.8f), {1.3f, 0.9f, 0.5f}, {0.1f, 2.2f, 0.2f}})
    scene.triangles.push_back({low, high, third});
  expect_rays(scene, "two one way, one the other");
  std::swap(scene.triangles.back().a, scene.triangles.back().b);
  expect_rays(scene, "the other way");
}

TEST_F(ShadowVolume, AnyNumberOfLayersHidesTheSun) {
  params_.set("cascades.size", 16);  // blended surfaces get maps
  for (const int layers : {1, 2, 252, 256, 507}) {
    TriangleScene scene = ground(32);
    for (int i = 0; i < layers; ++i) scene.add_quad({-3, 1 + 0.002f * static_cast<float>(i), 2}, {3, 0, 0}, {0, 0, -3});
    scene.to_light = glm::normalize(glm::vec3(0.1f, 1, 0));
    scene.view = glm::lookAt(glm::vec3(-1.2f, 0.5f, 0.8f), glm::vec3(-1.2f, 0, 0.8f), glm::vec3(0, 0, -1));
    scene.projection = orthographic(0.2f, 0.2f, 0.05f, 5);
    EXPECT_EQ(draw(scene).visibility(16, 16), 0) << layers;
  }
}

// Wherever the camera is, no pixel of a flat mesh is in shadow: not even those whose centres are within the
// rasteriser's fraction of a pixel of an edge, of which there are many here. Both triangles there have a side at that
// edge.
TEST_F(ShadowVolume, AFlatMeshDoesNotShadowItself) {
  TriangleScene scene;
  constexpr int cells = 24;
  const auto at = [](int x, int z) {
    const auto fraction = [](float v) { return v - std::floor(v); };
    const auto cell = glm::vec2(x, z);
    const glm::vec2 moved(0.6f * fraction(43.7f * std::sin(12.9f * cell.x + 78.2f * cell.y)),
                          0.6f * fraction(51.3f * std::sin(39.3f * cell.x + 11.1f * cell.y)));
    return 0.25f * glm::vec3(cell.x + moved.x - 0.5f * cells, 0, cell.y + moved.y - 0.5f * cells);
  };
  for (int z = 0; z < cells; ++z) {
    for (int x = 0; x < cells; ++x) {
      scene.triangles.push_back({at(x, z), at(x, z + 1), at(x + 1, z)});
      scene.triangles.push_back({at(x + 1, z), at(x, z + 1), at(x + 1, z + 1)});
    }
  }
  scene.width = scene.height = 256;
  scene.projection = perspective(0.7f, 1, 0.1f);
  int shown = 0, dark = 0;
  for (int view = 0; view < 24; ++view) {
    const float turn = 0.7f * static_cast<float>(view);
    scene.view = glm::lookAt(glm::vec3(5 * std::cos(turn), 0.4f + 0.05f * static_cast<float>(view), 5 * std::sin(turn)),
                             glm::vec3(0), glm::vec3(0, 1, 0));
    scene.to_light = sun_direction(31.0f * static_cast<float>(view), 10 + 2 * static_cast<float>(view));
    const Shadowed shadowed = draw(scene);
    for (int y = 0; y < shadowed.height; ++y) {
      for (int x = 0; x < shadowed.width; ++x) {
        if (shadowed.sky(x, y)) continue;
        ++shown;
        dark += shadowed.visibility(x, y) < 1 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(shown, 200'000);
  EXPECT_EQ(dark, 0);
}

// The volumes reach to infinity, and their caps may lie wholly beyond the far plane.
TEST_F(ShadowVolume, TheFarPlaneClipsNoVolume) {
  TriangleScene scene = ground();
  scene.add_quad({-20, 0, -25}, {40, 0, 0}, {0, 15, 0});
  scene.to_light = sun_direction(175, 25);
  scene.view = glm::lookAt(glm::vec3(0, 2, 8), glm::vec3(0, 0.5f, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.8f, 1, 0.1f);
  const Shadowed endless = draw(scene);
  EXPECT_EQ(compare(scene, endless).wrong, 0);
  glm::mat4 limited = glm::perspectiveRH_ZO(0.8f, 1.0f, 0.1f, 14.0f);
  const glm::mat4 reversed(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 1, 1);
  scene.projection = reversed * limited;
  const Shadowed near = draw(scene);
  const Comparison c = compare(scene, near);
  EXPECT_EQ(c.wrong, 0);
  EXPECT_GE(c.dark, 500);
}

}  // namespace
}  // namespace penumbra::test

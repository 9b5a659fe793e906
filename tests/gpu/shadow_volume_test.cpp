// The technique shadow_volume against closed forms, and against rays through the triangles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/render_scenes.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

// Distances along a ray below this, metres, are those of the surface that the ray starts on.
constexpr double on_surface = 1e-4;

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
    if (!(std::abs(distance) <= on_surface)) return distance > 0;
    const glm::dvec3 normal(glm::cross(triangle.b - triangle.a, triangle.c - triangle.a));
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

TEST_F(ShadowVolume, ThreeTrianglesMayShareAnEdge) {
  TriangleScene scene = ground();
  const glm::vec3 low(-0.5f, 1, 0.7f), high(0.4f, 1.6f, -0.6f);
  for (const glm::vec3 third : {glm::vec3(-1.2f, 1.1f, -0.8f), {1.3f, 0.9f, 0.5f}, {0.1f, 2.2f, 0.2f}})
    scene.triangles.push_back({low, high, third});
  expect_rays(scene, "two one way, one the other");
  std::swap(scene.triangles.back().a, scene.triangles.back().b);
  expect_rays(scene, "the other way");
}

// A surface of two triangles around a place, seen from 2 m before it, under a sun at that elevation above it.
TriangleScene tilted(const glm::vec3& place, float size, float tilt, float elevation) {
  const glm::mat3 turn(glm::rotate(glm::rotate(glm::mat4(1), tilt, {1, 0.3f, 0.2f}), 2 * tilt, {0, 1, 0}));
  TriangleScene scene;
  scene.add_quad(place - size * (turn[0] - turn[2]), 2 * size * turn[0], -2 * size * turn[2]);
  scene.width = scene.height = 64;
  const glm::mat4 view = glm::lookAt(turn * glm::vec3(0.3f, 0.6f, 2), glm::vec3(0), glm::vec3(0, 1, 0));
  scene.view = glm::mat4(glm::dmat4(view) * glm::translate(glm::dmat4(1), -glm::dvec3(place)));
  scene.projection = perspective(1, 1, 0.1f);
  scene.to_light = turn * sun_direction(130, elevation);
  return scene;
}

// Some reach behind the camera. The receivers are drawn at the origin, as by an engine that draws relative to the
// camera, and the casters there or far from it.
TEST_F(ShadowVolume, NoSurfaceShadowsItself) {
  std::ptrdiff_t shown = 0;
  for (const float away : {0.0f, 2000.0f}) {
    for (const float size : {1.0f, 30.0f, 1000.0f}) {
      for (const float tilt : {0.0f, 0.3f, 0.9f}) {
        for (const float elevation : {1.0f, 10.0f, 60.0f}) {
          const TriangleScene scene = tilted(glm::vec3(away, 0.7f * away, -away), size, tilt, elevation);
          const Geometry casters(scene);
          const Shadowed shadowed = draw(tilted(glm::vec3(0), size, tilt, elevation), [&](shadow::Inputs& in) {
            in.view.view = scene.view;
            in.casters = in.receivers = shadow::Box{glm::vec3(-5000), glm::vec3(5000)};
            in.draw = casters.casters();
          });
          const std::vector<float> seen = shadowed.visibilities();
          EXPECT_EQ(std::ranges::count(seen, 1.0f), std::ssize(seen))
              << size << " m, tilt " << tilt << ", sun " << elevation << ", at " << away;
          shown += std::ranges::count_if(shadowed.depth, [](float depth) { return depth > 0; });
        }
      }
    }
  }
  EXPECT_GT(shown, 50000);
}

TEST_F(ShadowVolume, WhatFacesAwayIsDarkThoughNothingCasts) {
  TriangleScene scene = box_on_ground(96);
  scene.to_light = sun_direction(200, 40);
  const Shadowed bare = draw(scene, [](shadow::Inputs& in) { in.draw = [](const shadow::CasterPass&, gl::Pass&) {}; });
  int dark = 0;
  for (std::size_t i = 0; i < bare.depth.size(); ++i) {
    const bool on_box = bare.points[i].y > 1e-4f && bare.points[i].y < 1.9999f && bare.depth[i] > 0;
    EXPECT_EQ(bare.mask[4 * i], on_box ? 0 : 1) << i;
    dark += on_box ? 1 : 0;
  }
  EXPECT_GT(dark, 200);
}

// The stencil counts modulo 256: a receiver that lies in a multiple of so many volumes counts as lit.
TEST_F(ShadowVolume, ManyLayersHideTheSunUnlessTheirNumberIsAMultipleOf256) {
  params_.set("cascades.size", 16);  // blended surfaces get maps
  const auto centre = [&](int layers) {
    TriangleScene scene = ground(32);
    for (int i = 0; i < layers; ++i) scene.add_quad({-3, 1 + 0.002f * static_cast<float>(i), 2}, {3, 0, 0}, {0, 0, -3});
    scene.to_light = glm::normalize(glm::vec3(0.1f, 1, 0));
    scene.view = glm::lookAt(glm::vec3(-1.2f, 0.5f, 0.8f), glm::vec3(-1.2f, 0, 0.8f), glm::vec3(0, 0, -1));
    scene.projection = orthographic(0.2f, 0.2f, 0.05f, 5);
    return draw(scene).visibility(16, 16);
  };
  for (const int layers : {1, 2, 255, 257, 300, 511}) EXPECT_EQ(centre(layers), 0) << layers;
  EXPECT_EQ(centre(256), 1) << "a limit of the stencil's 8 bits";
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

TEST_F(ShadowVolume, ConventionsFormatsViewportsAndJitterChangeNothing) {
  const TriangleScene scene = below_a_roof({-0.4f, 0.6f, 0.1f});
  const Shadowed expected = draw(scene);
  const auto differ = [&](const Shadowed& other) {
    int count = 0;
    for (std::size_t i = 0; i < expected.depth.size(); ++i) count += expected.mask[4 * i] != other.mask[4 * i] ? 1 : 0;
    return count;
  };
  // The middle of the picture as a view of its own, shifted by fractions of a pixel.
  const shadow::Rect middle{.x = 20, .y = 10, .width = 60, .height = 72};
  const glm::vec2 part(96.0f / 60, 96.0f / 72), begin((96.0f - 40) / 60 - 1, (96.0f - 20) / 72 - 1),
      jitter(0.007f, -0.012f);
  const glm::mat4 of_middle(part.x, 0, 0, 0, 0, part.y, 0, 0, 0, 0, 1, 0, begin.x - jitter.x, begin.y - jitter.y, 0, 1);
  const Shadowed own = draw(scene, [&](shadow::Inputs& in) {
    in.viewport = middle;
    in.view.projection = of_middle * in.view.projection;
    in.view.jitter = jitter;
  });
  for (int y = middle.y; y < middle.y + middle.height; ++y) {
    for (int x = middle.x; x < middle.x + middle.width; ++x)
      EXPECT_EQ(own.visibility(x, y), expected.visibility(x, y)) << x << ", " << y;
  }
  std::vector<float> away = expected.depth;
  for (float& stored : away) stored = 1 - stored;
  const glm::mat4 flip(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 1, 1);
  const glm::mat4 widen(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, -1, 1);
  for (const GLenum format : {GL_R32F, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT16}) {
    gl::Texture depth("depth", {.format = format, .width = 96, .height = 96});
    const GLenum channels = format == GL_R32F ? GL_RED : GL_DEPTH_COMPONENT;
    for (const bool reversed : {true, false}) {
      for (const bool from_zero : {true, false}) {
        depth.upload(channels, GL_FLOAT, std::as_bytes(std::span(reversed ? expected.depth : away)));
        const Shadowed other = draw(scene, [&](shadow::Inputs& in) {
          in.depth.id = depth.id();
          in.conventions.reversed_z = reversed;
          in.conventions.depth_zero_to_one = from_zero;
          if (!reversed) in.view.projection = flip * in.view.projection;
          if (!from_zero) in.view.projection = widen * in.view.projection;
        });
        // 16 bits at a distance of 8 m with a near plane at 0.1 m: 10 mm.
        EXPECT_LE(differ(other), format == GL_DEPTH_COMPONENT16 ? 96 : 2) << format << reversed << from_zero;
      }
    }
  }
}

TEST_F(ShadowVolume, OtherParametersAndTheSkyDoNotMatter) {
  TriangleScene scene = box_on_ground(96);
  scene.view = glm::lookAt(glm::vec3(2, 2, 6), glm::vec3(0, 1.5f, 0), glm::vec3(0, 1, 0));
  const Shadowed expected = draw(scene);
  const auto sky = static_cast<int>(std::ranges::count(expected.depth, 0.0f));
  EXPECT_GT(sky, 500);
  EXPECT_EQ(compare(scene, expected).wrong, 0) << "with the sky lit";
  params_.set("driver", std::string("compute"));
  params_.set("sun.angle", 8.0f);
  params_.set("cascades.size", 16);
  params_.set("filter.visibility", std::string("box"));
  EXPECT_EQ(draw(scene).mask, expected.mask);
  const std::vector<float> before = expected.mask;
  EXPECT_TRUE(std::ranges::all_of(before, [](float v) { return v == 0 || v == 1; }));
}

// A square with one side over a ground, under a sun above it.
class ShadowVolumeFaces : public RenderTest {
 protected:
  int dark_pixels(const glm::mat4& placed, const char* faces) {
    scene::Scene scene;
    const glm::mat4 lying = glm::rotate(glm::mat4(1), -1.5707963f, {1, 0, 0});
    add_node(scene, square(), glm::scale(glm::mat4(1), glm::vec3(4)) * lying);
    add_node(scene, square(), glm::translate(glm::mat4(1), {0, 1, 0}) * placed * lying);
    inputs.camera = inputs.last_camera = render::look_at({0, 0.9f, 3.9f}, {0, 0, 0}, 1.2f, 0.01f);
    sun().to_light = glm::normalize(glm::vec3(0.1f, 1, 0.1f));
    params.set_text("technique", "shadow_volume");
    params.set_text("casters.faces", faces);
    draw(scene);
    int dark = 0;
    const std::vector<float> depth = renderer.read_aov("depth"), shadow = renderer.read_aov("shadow");
    for (std::size_t i = 0; i < depth.size(); ++i) dark += depth[i] > 0 && shadow[i] < 0.5f ? 1 : 0;
    return dark;
  }
};

TEST_F(ShadowVolumeFaces, MirroredInstancesCastByTheFaceThatTheyShow) {
  const glm::mat4 plain(1), mirrored = glm::scale(glm::mat4(1), {-1, 1, 1});
  const int shadow = dark_pixels(plain, "front");
  EXPECT_GT(shadow, 50);
  EXPECT_EQ(dark_pixels(mirrored, "front"), shadow);
  EXPECT_EQ(dark_pixels(mirrored, "both"), shadow);
  EXPECT_EQ(dark_pixels(plain, "back"), 0);
  EXPECT_EQ(dark_pixels(mirrored, "back"), 0);
}

}  // namespace
}  // namespace penumbra::test

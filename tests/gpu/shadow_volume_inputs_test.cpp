// The technique shadow_volume: the caller's conventions, formats and faces, and what must not matter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/render_scenes.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

class ShadowVolumeInputs : public TriangleTest {
 protected:
  void SetUp() override {
    TriangleTest::SetUp();
    params_ = renderer_->params();
    params_.set("technique", std::string("shadow_volume"));
  }
  Shadowed draw(const TriangleScene& scene, const TriangleRenderer::Adjust& adjust = {}) {
    return renderer_->render(scene, params_, adjust);
  }

  ParamSet params_{std::vector<Param>{}};
};

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
TEST_F(ShadowVolumeInputs, NoSurfaceShadowsItself) {
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

TEST_F(ShadowVolumeInputs, WhatFacesAwayIsDarkThoughNothingCasts) {
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

// A box on a ground, seen from outside, and from within the shadow of a roof.
std::vector<TriangleScene> outside_and_inside() {
  std::vector<TriangleScene> scenes{box_on_ground(96), box_on_ground(96)};
  scenes[1].add_box({0.5f, 2.5f, 0.5f}, {2.5f, 2.6f, 3});
  scenes[1].view = glm::lookAt(glm::vec3(1.2f, 0.8f, 1.3f), glm::vec3(-3, 0.3f, 2), glm::vec3(0, 1, 0));
  scenes[1].to_light = sun_direction(60, 70);
  return scenes;
}

int different(const Shadowed& a, const Shadowed& b) {
  int count = 0;
  for (std::size_t i = 0; i < a.depth.size(); ++i) count += a.mask[4 * i] != b.mask[4 * i] ? 1 : 0;
  return count;
}

TEST_F(ShadowVolumeInputs, ConventionsAndFormatsOfDepthChangeNothing) {
  const glm::mat4 flip(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 1, 1);
  const glm::mat4 widen(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, -1, 1);
  for (const TriangleScene& scene : outside_and_inside()) {
    const Shadowed expected = draw(scene);
    std::vector<float> away = expected.depth;
    for (float& stored : away) stored = 1 - stored;
    for (const GLenum format : {GL_R32F, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT16}) {
      const gl::Texture depth("depth", {.format = format, .width = 96, .height = 96});
      const GLenum channel = format == GL_R32F ? GL_RED : GL_DEPTH_COMPONENT;
      for (const auto& [reversed, from_zero] : {std::pair(true, true), {true, false}, {false, true}, {false, false}}) {
        const std::vector<float>& stored = reversed ? expected.depth : away;
        if (format == GL_DEPTH_COMPONENT16) {
          // Of floats, drivers may round to either neighbour.
          std::vector<std::uint16_t> rounded;
          for (const float value : stored)
            rounded.push_back(static_cast<std::uint16_t>(std::lround(65535.0 * static_cast<double>(value))));
          depth.upload(channel, GL_UNSIGNED_SHORT, std::as_bytes(std::span(rounded)));
        } else {
          depth.upload(channel, GL_FLOAT, std::as_bytes(std::span(stored)));
        }
        const Shadowed other = draw(scene, [&](shadow::Inputs& in) {
          in.depth.id = depth.id();
          in.conventions.reversed_z = reversed;
          in.conventions.depth_zero_to_one = from_zero;
          if (!reversed) in.view.projection = flip * in.view.projection;
          if (!from_zero) in.view.projection = widen * in.view.projection;
        });
        // 16 bits at a distance of 8 m with a near plane at 0.1 m: 10 mm.
        EXPECT_LE(different(other, expected), format == GL_DEPTH_COMPONENT16 ? 96 : 2)
            << format << reversed << from_zero;
      }
    }
  }
}

// As with stereo views. What reads such depths reads a copy of them in floats, whose values are still those of the
// format.
TEST_F(ShadowVolumeInputs, NoSurfaceShadowsItselfThroughDepthsInAnArray) {
  for (const GLenum format : {GL_DEPTH_COMPONENT24, GL_DEPTH_COMPONENT16}) {
    for (const float tilt : {0.0f, 0.3f, 0.9f}) {
      const TriangleScene scene = tilted(glm::vec3(0), 30, tilt, 10);
      const gl::Texture layers(
          "layers",
          {.target = GL_TEXTURE_2D_ARRAY, .format = format, .width = scene.width, .height = scene.height, .layers = 2});
      const std::vector<float> stored = draw(scene).depth;
      const gl::Texture one("one layer", {.format = format, .width = scene.width, .height = scene.height});
      one.upload(GL_DEPTH_COMPONENT, GL_FLOAT, std::as_bytes(std::span(stored)));
      gl::glCopyImageSubData(one.id(), GL_TEXTURE_2D, 0, 0, 0, 0, layers.id(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 1,
                             scene.width, scene.height, 1);
      const Shadowed shadowed = draw(scene, [&](shadow::Inputs& in) {
        in.depth = {layers.id(), scene.width, scene.height, 1};
      });
      const std::vector<float> seen = shadowed.visibilities();
      EXPECT_EQ(std::ranges::count(seen, 1.0f), std::ssize(seen)) << format << ", tilt " << tilt;
    }
  }
}

// The middle of the picture as a view of its own, shifted by fractions of a pixel.
TEST_F(ShadowVolumeInputs, ViewportsAndJitterChangeNothing) {
  const shadow::Rect middle{.x = 20, .y = 10, .width = 60, .height = 72};
  const glm::vec2 part(96.0f / 60, 96.0f / 72), begin(56.0f / 60 - 1, 76.0f / 72 - 1), jitter(0.007f, -0.012f);
  const glm::mat4 of_middle(part.x, 0, 0, 0, 0, part.y, 0, 0, 0, 0, 1, 0, begin.x - jitter.x, begin.y - jitter.y, 0, 1);
  for (const TriangleScene& scene : outside_and_inside()) {
    const Shadowed expected = draw(scene);
    const Shadowed own = draw(scene, [&](shadow::Inputs& in) {
      in.viewport = middle;
      in.view.projection = of_middle * in.view.projection;
      in.view.jitter = jitter;
    });
    for (int y = middle.y; y < middle.y + middle.height; ++y) {
      for (int x = middle.x; x < middle.x + middle.width; ++x)
        EXPECT_EQ(own.visibility(x, y), expected.visibility(x, y)) << x << ", " << y;
    }
  }
}

TEST_F(ShadowVolumeInputs, OtherParametersAndTheSkyDoNotMatter) {
  TriangleScene scene = box_on_ground(96);
  scene.view = glm::lookAt(glm::vec3(2, 2, 6), glm::vec3(0, 1.5f, 0), glm::vec3(0, 1, 0));
  const Shadowed expected = draw(scene);
  const auto sky = static_cast<int>(std::ranges::count(expected.depth, 0.0f));
  EXPECT_GT(sky, 500);
  for (std::size_t i = 0; i < expected.depth.size(); ++i)
    EXPECT_TRUE(expected.depth[i] > 0 || expected.mask[4 * i] == 1);
  params_.set("driver", std::string("compute"));
  params_.set("sun.angle", 8.0f);
  params_.set("cascades.size", 16);
  params_.set("filter.visibility", std::string("box"));
  EXPECT_EQ(draw(scene).mask, expected.mask);
  EXPECT_TRUE(std::ranges::all_of(expected.mask, [](float v) { return v == 0 || v == 1; }));
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

// Normals as engines store them: packed and unsigned ones with a scale and an offset, and none at all.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/triangle_scene.h"
#include "lib/octahedral.glsl"

namespace penumbra::test {
namespace {

using ShadowNormals = TriangleTest;

// How normals n are stored: 0.5 + 0.5 n, of x, y and z or of the octahedral map.
struct Storage {
  const char* name;
  GLenum format;
  bool octahedral;
};

constexpr Storage storages[] = {
    {"RGBA8", GL_RGBA8, false},
    {"RGB10_A2", GL_RGB10_A2, false},
    {"RGBA16", GL_RGBA16, false},
    {"RG16, octahedral", GL_RG16, true},
};

// A ground of 40 m with boxes and a roof on it, and walls that face every way.
TriangleScene yard() {
  TriangleScene scene;
  scene.add_quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  scene.add_box({-3, 0, -3}, {-1, 2, -1});
  scene.add_box({3, 0, -9}, {4, 5, -7});
  scene.add_quad({1, 0, 2}, {2, 0, 1}, {0.3f, 2, 0});
  scene.add_quad({-6, 3, -9}, {0, 0.5f, -3}, {4, 0, 0});
  scene.width = 200;
  scene.height = 125;
  scene.view = glm::lookAt(glm::vec3(2, 4, 12), glm::vec3(0, 0, -4), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.87f, 1.6f, 0.1f);
  return scene;
}

// Stores the normals of a frame's inputs in another way.
void store(gl::Device& device, const Storage& as, shadow::Inputs& inputs) {
  const int width = inputs.normals.width, height = inputs.normals.height;
  const gl::Texture& given = device.target("test normals", {.format = GL_RG32F, .width = width, .height = height});
  const std::vector<float> from = gl::read_floats(given, 2);
  std::vector<glm::vec4> stored;
  for (size_t i = 0; i < from.size(); i += 2) {
    const glm::vec2 encoded(from[i], from[i + 1]);
    const glm::vec3 n = as.octahedral ? glm::vec3(encoded, 0) : glsl::octahedral_decode(encoded);
    stored.emplace_back(0.5f + 0.5f * n, 1);
  }
  const gl::Texture& to = device.target(as.name, {.format = as.format, .width = width, .height = height});
  to.upload(GL_RGBA, GL_FLOAT, std::as_bytes(std::span(stored)));
  inputs.normals.id = to.id();
  inputs.conventions.octahedral_normals = as.octahedral;
  inputs.conventions.normals_scale = 2;
  inputs.conventions.normals_offset = -1;
}

// Of the pixels that show no sky: how many there are, how many differ, and how many of those are darker.
struct Differences {
  int all = 0, wrong = 0, darker = 0;
};

Differences between(const Shadowed& exact, const Shadowed& shadowed) {
  Differences found;
  for (int y = 0; y < exact.height; ++y) {
    for (int x = 0; x < exact.width; ++x) {
      if (exact.sky(x, y)) continue;
      ++found.all;
      const float change = shadowed.visibility(x, y) - exact.visibility(x, y);
      if (std::abs(change) > 0.1f) ++found.wrong;
      if (change < -0.1f) ++found.darker;
    }
  }
  return found;
}

TEST_F(ShadowNormals, UnsignedFormatsShowNoAcneAndLoseNoShadow) {
  TriangleScene scene = yard();
  scene.to_light = sun_direction(35, 40);
  for (const std::string technique : {"hard", "pcss"}) {
    ParamSet params = renderer_->params();
    params.set("technique", technique);
    const Shadowed exact = renderer_->render(scene, params);
    for (const Storage& as : storages) {
      const Shadowed shadowed =
          renderer_->render(scene, params, [&](shadow::Inputs& inputs) { store(renderer_->device(), as, inputs); });
      const Differences found = between(exact, shadowed);
      ASSERT_GT(found.all, 15000);
      EXPECT_LE(found.wrong, found.all / 1000) << technique << ", " << as.name;
    }
  }
}

// Without normals, only pixels at outlines differ.
TEST_F(ShadowNormals, AreMadeFromDepth) {
  struct Buffer {
    const char* name;
    GLenum format;
    bool reversed;
  };
  for (const Buffer& buffer : {Buffer{"32-bit float, reversed", GL_DEPTH_COMPONENT32F, true},
                               {"24 bits, near 0.1", GL_DEPTH_COMPONENT24, false}}) {
    TriangleScene scene = yard();
    scene.depth_format = buffer.format;
    scene.conventions.reversed_z = scene.conventions.depth_zero_to_one = buffer.reversed;
    if (!buffer.reversed) scene.projection = standard_perspective(0.87f, 1.6f, 0.1f, 200);
    for (const float elevation : {15.0f, 40.0f}) {
      scene.to_light = sun_direction(35, elevation);
      for (const std::string technique : {"hard", "pcss", "slices"}) {
        ParamSet params = renderer_->params();
        params.set("technique", technique);
        const Shadowed exact = renderer_->render(scene, params);
        const Shadowed made = renderer_->render(scene, params, [](shadow::Inputs& inputs) { inputs.normals = {}; });
        // Where interpolated normals are those of the triangles, they show which neighbours belong to a pixel's
        // surface.
        const Shadowed guided =
            renderer_->render(scene, params, [](shadow::Inputs& inputs) { inputs.conventions.shading_normals = true; });
        EXPECT_LE(between(exact, guided).wrong, 1) << technique << ", " << buffer.name << ", sun at " << elevation;
        const Differences found = between(exact, made);
        ASSERT_GT(found.all, 15000);
        const std::string of = technique + ", " + buffer.name + ", sun at " + std::to_string(elevation);
        EXPECT_LE(found.darker, found.all / 1000) << of;
        EXPECT_LE(found.wrong, found.all / 200) << of;
      }
    }
  }
}

// A ball of radius 1 with few facets on a ground at y = -1.
TriangleScene ball_on_ground() {
  TriangleScene scene;
  scene.add_quad({-20, -1, 20}, {40, 0, 0}, {0, 0, -40});
  constexpr int rings = 12, sectors = 24;
  const auto on_ball = [](int ring, int sector) {
    const float down = glm::pi<float>() * static_cast<float>(ring) / rings;
    const float around = glm::two_pi<float>() * static_cast<float>(sector) / sectors;
    return glm::vec3(std::sin(down) * std::cos(around), std::cos(down), -std::sin(down) * std::sin(around));
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int sector = 0; sector < sectors; ++sector) {
      const glm::vec3 a = on_ball(ring, sector), b = on_ball(ring + 1, sector), c = on_ball(ring + 1, sector + 1),
                      d = on_ball(ring, sector + 1);
      if (ring < rings - 1) scene.triangles.push_back({a, b, c});
      if (ring > 0) scene.triangles.push_back({a, c, d});
    }
  }
  scene.width = 400;
  scene.height = 250;
  scene.view = glm::lookAt(glm::vec3(1, 1.5f, 4), glm::vec3(0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.87f, 1.6f, 0.1f);
  return scene;
}

// Of each pixel of the ball the smooth normal, of others what is given; in the octahedral map.
std::vector<float> smooth_normals(const Shadowed& shadowed, std::vector<float> normals) {
  for (std::size_t i = 0; i < shadowed.points.size(); ++i) {
    const float length = glm::length(shadowed.points[i]);
    if (length > 1.02f || shadowed.points[i].y < -0.97f) continue;
    const glm::vec2 encoded = glsl::octahedral_encode(shadowed.points[i] / length);
    normals[2 * i] = encoded.x;
    normals[2 * i + 1] = encoded.y;
  }
  return normals;
}

// Only facets at the outline that are narrower than 3 pixels are left.
TEST_F(ShadowNormals, ThoseOfShadingLeaveNoSpeckle) {
  TriangleScene scene = ball_on_ground();
  gl::Device& device = renderer_->device();
  for (const float elevation : {20.0f, 50.0f}) {
    scene.to_light = sun_direction(35, elevation);
    for (const std::string technique : {"hard", "pcss", "slices"}) {
      ParamSet params = renderer_->params();
      params.set("technique", technique);
      const Shadowed exact = renderer_->render(scene, params);
      const gl::Texture& given =
          device.target("test normals", {.format = GL_RG32F, .width = scene.width, .height = scene.height});
      const std::vector<float> smooth = smooth_normals(exact, gl::read_floats(given, 2));
      const auto render_with = [&](bool said) {
        return renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
          const gl::Texture& texture =
              device.target("smooth normals", {.format = GL_RG32F, .width = scene.width, .height = scene.height});
          texture.upload(GL_RG, GL_FLOAT, std::as_bytes(std::span(smooth)));
          inputs.normals.id = texture.id();
          inputs.conventions.shading_normals = said;
        });
      };
      const Differences unsaid = between(exact, render_with(false)), said = between(exact, render_with(true));
      EXPECT_LE(said.wrong, said.all / 1000) << technique << ", sun at " << elevation;
      EXPECT_GE(unsaid.wrong, 3 * said.wrong) << technique << ", sun at " << elevation;
    }
  }
}

// Also those of a frame after which one had no lights.
TEST_F(ShadowNormals, ThatWereMadeAreReleasedOnceTheCallerBringsSome) {
  const TriangleScene scene = yard();
  const auto frame = [&](bool brings, bool lit) {
    renderer_->render(scene, renderer_->params(), [&](shadow::Inputs& in) {
      if (!brings) in.normals = {};
      if (!lit) in.lights = {};
    });
    const auto names = renderer_->device().names("");
    return std::ranges::count_if(
        names, [](std::string_view name) { return name.find("normals from depth") != std::string_view::npos; });
  };
  EXPECT_EQ(frame(false, true), 1);
  EXPECT_EQ(frame(false, false), 1);
  EXPECT_EQ(frame(true, true), 0);
}

// The warm-up reads textures of the frame's formats.
TEST_F(ShadowNormals, AreWarmedUpInTheirFormat) {
  const shadow::Light light{.source = shadow::Sun{sun_direction(35, 40)}};
  for (const GLenum depth : {GL_DEPTH_COMPONENT24, GL_DEPTH24_STENCIL8, GL_DEPTH_COMPONENT32F, GL_R32F}) {
    for (const Storage& as : storages) {
      const gl::Texture depths("depth", {.format = depth, .width = 8, .height = 8});
      const gl::Texture normals("normals", {.format = as.format, .width = 8, .height = 8});
      shadow::FrameKind kind{.lights = {&light, 1}, .depth = {.id = depths.id()}, .normals = {.id = normals.id()}};
      kind.conventions.octahedral_normals = as.octahedral;
      kind.conventions.normals_scale = 2;
      kind.conventions.normals_offset = -1;
      EXPECT_NO_THROW(renderer_->shadows().warm_up(kind, renderer_->params())) << as.name;
      kind.conventions.normals_scale = 1;
      kind.conventions.normals_offset = 0;
      EXPECT_NE(message_of([&] { renderer_->shadows().warm_up(kind, renderer_->params()); }).find("normals"),
                std::string::npos)
          << as.name;
    }
  }
}

}  // namespace
}  // namespace penumbra::test

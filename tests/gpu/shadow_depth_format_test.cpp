// Depth buffers of engines: what their formats and projections round away must not show as shadow.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/log.h"
#include "gpu/triangle_scene.h"
#include "shadow/depth_precision.h"

namespace penumbra::test {
namespace {

using ShadowDepthFormat = TriangleTest;

struct DepthBuffer {
  const char* name;
  GLenum format;
  float near;
  bool reversed;
};

constexpr DepthBuffer buffers[] = {
    {"32-bit float, near 0.1", GL_DEPTH_COMPONENT32F, 0.1f, false},
    {"24 bits, near 0.1", GL_DEPTH_COMPONENT24, 0.1f, false},
    {"32-bit float, near 0.01", GL_DEPTH_COMPONENT32F, 0.01f, false},
    {"24 bits, near 0.01", GL_DEPTH_COMPONENT24, 0.01f, false},
    {"24 bits and stencil, near 0.01", GL_DEPTH24_STENCIL8, 0.01f, false},
    {"16 bits, near 1", GL_DEPTH_COMPONENT16, 1, false},
    {"32-bit float, reversed, near 0.001", GL_DEPTH_COMPONENT32F, 0.001f, true},
    {"half floats, reversed, near 0.1", GL_R16F, 0.1f, true},
};

TriangleScene seen_through(TriangleScene scene, const DepthBuffer& buffer) {
  const float aspect = static_cast<float>(scene.width) / static_cast<float>(scene.height);
  const float fov = glm::radians(50.0f);
  scene.depth_format = buffer.format;
  scene.conventions.reversed_z = scene.conventions.depth_zero_to_one = buffer.reversed;
  scene.projection =
      buffer.reversed ? perspective(fov, aspect, buffer.near) : standard_perspective(fov, aspect, buffer.near, 200);
  return scene;
}

// A ground of 40 m with a box and a roof on it, and walls that face every way.
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
  return scene;
}

// Of the receivers that show no sky: how many there are, and how many count by a rule.
struct Share {
  int counted = 0, all = 0;
};

template <class Counts>
Share share_of(const Shadowed& exact, Counts counts) {
  Share share;
  for (int y = 0; y < exact.height; ++y) {
    for (int x = 0; x < exact.width; ++x) {
      if (exact.sky(x, y)) continue;
      ++share.all;
      if (counts(x, y)) ++share.counted;
    }
  }
  return share;
}

const DepthBuffer exact_buffer{"", GL_DEPTH_COMPONENT32F, 0.1f, true};

TEST_F(ShadowDepthFormat, RoundedDepthsShowNoAcne) {
  for (const std::string technique : {"hard", "pcss", "slices", "backprojection"}) {
    for (const float elevation : {15.0f, 50.0f}) {
      TriangleScene scene = yard();
      scene.to_light = sun_direction(35, elevation);
      ParamSet params = renderer_->params();
      params.set("technique", technique);
      const Shadowed exact = renderer_->render(seen_through(scene, exact_buffer), params);
      for (const DepthBuffer& buffer : buffers) {
        const Shadowed shadowed = renderer_->render(seen_through(scene, buffer), params);
        const Share dark = share_of(
            exact, [&](int x, int y) { return exact.visibility(x, y) > 0.99f && shadowed.visibility(x, y) < 0.9f; });
        ASSERT_GT(dark.all, 15000);
        EXPECT_LE(dark.counted, dark.all / 1000)
            << technique << ", " << buffer.name << ", sun at " << elevation << " degrees";
      }
    }
  }
}

TEST_F(ShadowDepthFormat, UsualBuffersLoseNoShadow) {
  TriangleScene scene = yard();
  scene.to_light = sun_direction(35, 50);
  ParamSet params = renderer_->params();
  params.set("technique", "pcss");
  const Shadowed exact = renderer_->render(seen_through(scene, exact_buffer), params);
  for (const DepthBuffer& buffer : buffers) {
    if (buffer.near != 0.1f && !buffer.reversed) continue;
    const Shadowed shadowed = renderer_->render(seen_through(scene, buffer), params);
    const Share wrong = share_of(
        exact, [&](int x, int y) { return std::abs(shadowed.visibility(x, y) - exact.visibility(x, y)) > 0.1f; });
    EXPECT_LE(wrong.counted, wrong.all / 1000) << buffer.name;
  }
}

// The bound itself: positions from the stored depths lie no further from the surface than it says, and not much nearer.
TEST_F(ShadowDepthFormat, ErrorsAreWithinTheBound) {
  TriangleScene scene;
  scene.add_quad({-20, 0, 20}, {40, 0, 0}, {0, 0, -40});
  scene.width = 200;
  scene.height = 125;
  scene.view = glm::lookAt(glm::vec3(2, 4, 12), glm::vec3(0, 0, -4), glm::vec3(0, 1, 0));
  for (const DepthBuffer& buffer : buffers) {
    scene = seen_through(scene, buffer);
    shadow::NdcError bound;
    const Shadowed shadowed = renderer_->render(scene, renderer_->params(), [&](shadow::Inputs& inputs) {
      bound = shadow::ndc_error(shadow::depth_rounding_of(inputs.depth.id), scene.conventions, scene.projection);
    });
    const glm::dmat4 world_to_clip = glm::dmat4(scene.projection) * glm::dmat4(scene.view);
    const glm::dmat4 clip_to_world = glm::inverse(world_to_clip);
    // Where the pixel's ray, from one depth to another, meets the ground.
    const auto exact_at = [&](int x, int y) {
      const glm::dvec2 at((x + 0.5) / scene.width * 2 - 1, (y + 0.5) / scene.height * 2 - 1);
      const glm::dvec4 first = clip_to_world * glm::dvec4(at, 0.25, 1);
      const glm::dvec4 second = clip_to_world * glm::dvec4(at, 0.75, 1);
      const glm::dvec3 a = glm::dvec3(first) / first.w;
      const glm::dvec3 b = glm::dvec3(second) / second.w;
      const glm::dvec4 clip = world_to_clip * glm::dvec4(glm::mix(a, b, a.y / (a.y - b.y)), 1);
      return clip.z / clip.w;
    };
    double most = 0;
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        if (shadowed.sky(x, y)) continue;
        const double stored = shadowed.depth[static_cast<size_t>(y * scene.width + x)];
        const double ndc = scene.conventions.depth_zero_to_one ? stored : 2 * stored - 1;
        const double exact = exact_at(x, y);
        // The rasteriser rounds vertices.
        const double beside = std::abs(exact_at(x + 1, y) - exact) + std::abs(exact_at(x, y + 1) - exact);
        const double off = std::abs(ndc - exact) - renderer_->device().vertex_rounding() * beside;
        most = std::max(most, off / (bound.absolute + bound.relative * std::abs(ndc)));
      }
    }
    EXPECT_LE(most, 1) << buffer.name;
  }
}

TEST_F(ShadowDepthFormat, AHopelessBufferIsToldOnce) {
  std::vector<std::string> warnings;
  set_log_sink([&](LogLevel level, std::string_view line) {
    if (level == LogLevel::warning) warnings.emplace_back(line);
  });
  TriangleScene scene = yard();
  scene.to_light = sun_direction(35, 50);
  for (const DepthBuffer& buffer : buffers) renderer_->render(seen_through(scene, buffer), renderer_->params());
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  const TriangleScene hopeless = seen_through(scene, {"", GL_DEPTH_COMPONENT16, 0.01f, false});
  for (int frame = 0; frame < 3; ++frame) renderer_->render(hopeless, renderer_->params());
  set_log_sink({});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("the depth texture tells positions"), std::string::npos) << warnings[0];
}

}  // namespace
}  // namespace penumbra::test

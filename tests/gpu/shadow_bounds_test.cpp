// Bounds that reach far, because of far objects or because an engine gives those of its whole world: near shadows stay
// right.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/log.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr float distances[] = {1e4f, 1e5f, 1e6f};  // metres

class ShadowBounds : public TriangleTest {
 protected:
  void SetUp() override {
    TriangleTest::SetUp();
    set_log_sink([this](LogLevel level, std::string_view line) {
      if (level == LogLevel::warning) warnings.emplace_back(line);
    });
    params = renderer_->params();
    params.set("technique", std::string("hard"));
    near = renderer_->render(scene, params);
  }
  void TearDown() override {
    set_log_sink({});
    TriangleTest::TearDown();
  }
  // How many of the near scene's pixels have another shadow, of those that show it in both pictures.
  int changed(const Shadowed& far) const {
    int count = 0;
    for (int y = 0; y < scene.height; ++y) {
      for (int x = 0; x < scene.width; ++x) {
        const bool same_place = glm::distance(near.point(x, y), far.point(x, y)) < 0.01f;
        if (near.sky(x, y) || !same_place) continue;
        if (std::abs(near.visibility(x, y) - far.visibility(x, y)) > 0.5f) ++count;
      }
    }
    return count;
  }

  TriangleScene scene = box_on_ground(256);
  ParamSet params;
  Shadowed near;  // of the scene with its own bounds
  std::vector<std::string> warnings;
};

// Pixels whose shadow may differ: those on its edge, since texels are wider in wide bounds.
constexpr int on_edges = 60;

TEST_F(ShadowBounds, WideBoundsLeaveNearShadows) {
  int shadowed = 0;
  for (const float visibility : near.visibilities()) shadowed += visibility < 0.5f ? 1 : 0;
  ASSERT_GT(shadowed, 20 * on_edges);
  for (const float distance : distances) {
    scene.casters = scene.receivers = shadow::Box{glm::vec3(-distance), glm::vec3(distance)};
    const Shadowed far = renderer_->render(scene, params);
    EXPECT_LE(changed(far), on_edges) << distance;
  }
}

TEST_F(ShadowBounds, FarObjectsLeaveNearShadows) {
  for (const float distance : distances) {
    TriangleScene with_far = scene;
    with_far.add_box({-0.1f * distance, 0, -1.2f * distance}, {0.1f * distance, 0.2f * distance, -distance});
    const Shadowed far = renderer_->render(with_far, params);
    EXPECT_LE(changed(far), on_edges) << distance;
  }
}

TEST_F(ShadowBounds, FarGroundLeavesNearShadows) {
  for (const float distance : distances) {
    TriangleScene with_far = scene;
    with_far.add_quad({-distance, -1, distance}, {2 * distance, 0, 0}, {0, 0, -2 * distance});
    const Shadowed far = renderer_->render(with_far, params);
    EXPECT_LE(changed(far), on_edges) << distance;
  }
}

TEST_F(ShadowBounds, CastersFarAlongTheLightLeaveNearShadows) {
  for (const float distance : distances) {
    TriangleScene with_far = scene;
    const glm::vec3 beside = glm::normalize(glm::cross(scene.to_light, glm::vec3(0, 1, 0)));
    const glm::vec3 at = distance * scene.to_light + 0.1f * distance * beside;
    with_far.add_box(at, at + 0.01f * distance);
    with_far.receivers = shadow::Box{{-5, 0, -5}, {5, 2, 5}};
    const Shadowed far = renderer_->render(with_far, params);
    EXPECT_LE(changed(far), on_edges) << distance;
  }
}

TEST_F(ShadowBounds, WhatIsLeftOutIsSaidOnce) {
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  scene.casters = scene.receivers = shadow::Box{glm::vec3(-1e5f), glm::vec3(1e5f)};
  for (int frame = 0; frame < 3; ++frame) renderer_->render(scene, params);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("receivers more than 1 km from the camera are lit, and casters more than 10 km before"),
            std::string::npos)
      << warnings[0];
}

TEST_F(ShadowBounds, ExactBoundsAndRangesAreTaken) {
  scene.casters = scene.receivers = shadow::Box{glm::vec3(-1e5f), glm::vec3(1e5f)};
  const Shadowed exact = renderer_->render(scene, params, [](shadow::Inputs& in) { in.exact_bounds = true; });
  EXPECT_GT(changed(exact), 5 * on_edges) << "maps of all of the bounds are coarse";
  EXPECT_TRUE(warnings.empty()) << warnings.front();
  scene.casters = {{-1e5f, -10, -1e5f}, {1e5f, 10, 1e5f}};  // not as high as they are wide
  params.set("cascades.distance", 20.0f);
  const Shadowed ranged = renderer_->render(scene, params);
  EXPECT_LE(changed(ranged), on_edges);
}

}  // namespace
}  // namespace penumbra::test

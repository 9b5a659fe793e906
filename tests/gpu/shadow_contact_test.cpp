// An object close to the ground keeps its shadow where a tall caster makes the blocker search wide.

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

using ShadowContact = TriangleTest;

// A slab 5 cm over the ground, and the edge of a roof 20 m up that hides nothing of it. Under a sun of 8 degrees the
// roof requires a search disc of 1.4 m, and the light's cone is 7 mm wide where the slab is.
TEST_F(ShadowContact, AFootKeepsItsShadowUnderAWideSun) {
  TriangleScene scene;
  scene.add_quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8});
  scene.add_box({-0.5f, 0.05f, -0.5f}, {0.5f, 0.06f, 0.5f});
  scene.add_quad({1.24f, 20, 20}, {20, 0, 0}, {0, 0, -40});
  scene.receivers = shadow::Box{{-4, 0, -4}, {4, 0.06f, 4}};
  scene.width = scene.height = 128;
  // The camera is below the slab's edge and sees the ground under it.
  scene.view = glm::lookAt(glm::vec3(-0.3f, 0.04f, 2), glm::vec3(-0.3f, 0, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.25f, 1, 0.01f);
  for (const int taps : {8, 16}) {
    ParamSet params = renderer_->params();
    params.set("sun.angle", 8.0f);
    params.set("cascades.size", 1024);
    params.set("pcss.blocker_taps", taps);
    params.set("pcss.filter_taps", taps);
    const Shadowed shadowed = renderer_->render(scene, params);
    int under = 0;
    for (int y = 0; y < 128; ++y) {
      for (int x = 0; x < 128; ++x) {
        const glm::vec3& point = shadowed.point(x, y);
        const bool core = point.x > -0.4f && point.x < -0.17f && std::abs(point.z) < 0.4f && point.y < 0.01f;
        if (shadowed.sky(x, y) || !core) continue;
        ++under;
        EXPECT_LT(shadowed.visibility(x, y), 0.05f) << point.x << ", " << point.z << ", " << taps << " taps";
      }
    }
    EXPECT_GT(under, 50);
  }
}

}  // namespace
}  // namespace penumbra::test

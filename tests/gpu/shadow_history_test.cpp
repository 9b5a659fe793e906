// A surface that appears from behind another takes nothing of it along.

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr float pixel = 0.1f;  // of the wall, metres

// A screen before a wall, twice as near. A caster out of view darkens all of the screen and nothing else that is seen.
TriangleScene screen_before_wall(float eye_x) {
  TriangleScene scene;
  scene.add_quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0});
  scene.add_quad({-40, -20, -8}, {80, 0, 0}, {0, 40, 0});
  scene.add_quad({-2, 4, 6}, {4, 0, 0}, {0, 4, 0});
  scene.to_light = glm::normalize(glm::vec3(0, 1, 1));
  scene.view = glm::lookAt(glm::vec3(eye_x, 0, 8), glm::vec3(eye_x, 0, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(2 * std::atan(0.3f), 1, 0.1f);
  scene.width = scene.height = 96;
  return scene;
}

class ShadowHistory : public TriangleTest {
 protected:
  // Pixels that are neither dark nor lit after some steps to the side, each of so many pixels of the wall.
  int mixed_pixels(const ParamSet& params, float step) {
    int mixed = 0;
    glm::mat4 last_view(1);
    for (int frame = 0; frame < 8; ++frame) {
      const TriangleScene scene = screen_before_wall(step * pixel * static_cast<float>(frame));
      const Shadowed shadowed = renderer_->render(scene, params, [&](shadow::Inputs& inputs) {
        inputs.view.last_view = last_view;
        inputs.view.last_projection = scene.projection;
      });
      last_view = scene.view;
      mixed = 0;
      for (const float visibility : shadowed.visibilities()) mixed += visibility > 0 && visibility < 1 ? 1 : 0;
    }
    return mixed;
  }
};

TEST_F(ShadowHistory, NothingTrailsBehindAnEdge) {
  ParamSet params = renderer_->params();
  params.set("history.reuse", true);
  for (const char* driver : {"fragment", "compute"}) {
    params.set("driver", std::string(driver));
    for (const float step : {1.0f, 0.5f, 1.37f}) EXPECT_EQ(mixed_pixels(params, step), 0) << driver << ", " << step;
  }
  params.set("history.distance", 100.0f);
  EXPECT_GT(mixed_pixels(params, 1), 20) << "the picture shows no trail at all";
}

}  // namespace
}  // namespace penumbra::test

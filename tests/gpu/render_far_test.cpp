// Scenes far from the world's origin have the shadows that they have at it.
#include <cmath>
#include <vector>

#include "render_scenes.h"

namespace penumbra::test {
namespace {

class FarFromTheOrigin : public RenderTest {
 protected:
  FarFromTheOrigin() { params.set_text("technique", "pcss"); }

  // Of a small square before a wall, lit from in front of the wall.
  std::vector<float> visibility_at(const glm::vec3& origin, render::FrameLight light) {
    scene::Scene scene;
    const glm::mat4 here = glm::translate(glm::mat4(1), origin);
    add_node(scene, square(), glm::scale(here, glm::vec3(4)));
    add_node(scene, square(), glm::scale(glm::translate(here, glm::vec3(0.3f, -0.2f, 1.5f)), glm::vec3(0.8f)));
    if (auto* lamp = std::get_if<render::LampLight>(&light)) {
      lamp->position += origin;
      // A shade behind the lamp: the near plane of its maps is so near, too.
      add_node(scene, square(),
               glm::scale(glm::translate(glm::mat4(1), lamp->position + glm::vec3(0, 0, 0.03f)), glm::vec3(0.02f)));
    }
    inputs.camera = inputs.last_camera = render::look_at(origin + glm::vec3(0, 1, 6), origin, 1.0f, 0.01f);
    inputs.lights = {light};
    draw(scene);
    return renderer.read_aov("shadow");
  }

  void expect_same_shadows(float metres, const render::FrameLight& light) {
    const std::vector<float> near = visibility_at(glm::vec3(0), light);
    const std::vector<float> far = visibility_at(metres * glm::vec3(1, 0, -1), light);
    double lit = 0, difference = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
      lit += static_cast<double>(near[i]);
      difference += static_cast<double>(std::abs(far[i] - near[i]));
    }
    const auto pixels = static_cast<double>(near.size());
    EXPECT_GT(lit, 0.5 * pixels);
    EXPECT_LT(lit, 0.99 * pixels);
    EXPECT_LT(difference, 0.002 * pixels) << metres << " m";
  }
};

TEST_F(FarFromTheOrigin, LampsShineAsAtIt) {
  for (const float metres : {100.0f, 2000.0f})
    expect_same_shadows(metres, render::LampLight{.position = {1, 0.8f, 3}, .radius = 0.1f});
}

TEST_F(FarFromTheOrigin, SunsShineAsAtIt) {
  for (const float metres : {1000.0f, 10000.0f})
    expect_same_shadows(metres, render::SunLight{.to_light = glm::normalize(glm::vec3(0.4f, 0.5f, 1))});
}

}  // namespace
}  // namespace penumbra::test

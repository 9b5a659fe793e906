// The floor of bench reads the discs of the technique that it is measured beside.
#include <cmath>
#include <string>

#include "bench/floor.h"
#include "render_scenes.h"

namespace penumbra::test {
namespace {

class BenchFloorTest : public RenderTest {
 protected:
  BenchFloorTest() {
    params.set_text("technique", "pcss");
    params.set_text("sun.angle", "3");
    for (const auto& [name, value] : bench::values_for_floor(params)) params.set(name, value);
    inputs.camera = inputs.last_camera = render::look_at({0, 0, 8}, {0, 0, 0}, 0.5f, 0.01f);
    inputs.mask_details = true;
    // A square that hides from each of two suns a different part of a wall.
    add_node(scene_, square(), glm::scale(glm::mat4(1), glm::vec3(4)));
    add_node(scene_, square(), glm::translate(glm::scale(glm::mat4(1), glm::vec3(0.4f)), glm::vec3(0, 0, 2)));
    inputs.lights = {render::SunLight{.to_light = glm::normalize(glm::vec3(0.6f, 0, 1))},
                     render::SunLight{.to_light = glm::normalize(glm::vec3(-0.5f, 0.3f, 1))}};
  }

  static std::vector<float> radii_of(const render::Frame& frame, int layer) {
    const std::vector<float> texels = gl::read_floats(*frame.mask.texture, 4, 0, layer);
    std::vector<float> radii;
    for (std::size_t i = 1; i < texels.size(); i += 4) radii.push_back(texels[i]);
    return radii;
  }

  scene::Scene scene_;
};

TEST_F(BenchFloorTest, HasForEachLightTheFiltersOfThatLight) {
  for (const char* driver : {"fragment", "compute"}) {
    params.set_text("driver", driver);
    const render::Frame& frame = draw(scene_);
    bench::Floor floor(renderer.registry().find("pcss"), params, scene_, gl::ShaderFiles(), gl::Timers::Mode::off);
    floor.take_kernels(*frame.mask.texture);
    const render::Frame& of_floor = floor.draw(inputs, params);
    ASSERT_EQ(of_floor.mask.texture->desc().layers, 2);
    for (int layer = 0; layer < 2; ++layer) {
      const std::vector<float> radii = radii_of(frame, layer), read = radii_of(of_floor, layer);
      EXPECT_GT(std::ranges::count_if(radii, [](float radius) { return radius > 0; }), 20) << layer;
      for (std::size_t i = 0; i < radii.size(); ++i) ASSERT_NEAR(read[i], radii[i], 2e-3f * radii[i]) << i;
    }
    EXPECT_NE(radii_of(frame, 0), radii_of(frame, 1));
  }
}

TEST_F(BenchFloorTest, IsNoneOfATechniqueThatReadsAllTexels) {
  params.set_text("technique", "brute_force");
  const shadow::Technique& technique = renderer.registry().find("brute_force");
  for (const bool all : {false, true}) {
    params.set("brute_force.every_texel", all);
    const bench::Floor floor(technique, params, scene_, gl::ShaderFiles(), gl::Timers::Mode::off);
    EXPECT_EQ(floor.has_fetches(), !all);
  }
}

}  // namespace
}  // namespace penumbra::test

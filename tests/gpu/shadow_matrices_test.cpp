// Shadow maps that an engine draws with matrices of its own give the shadows of the library's own maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/triangle_scene.h"
#include "shadow/light_matrices.h"

namespace penumbra::test {
namespace {

constexpr int size = 1024;

// Slices of the view as engines fit them: each about a part of the ground, so that the coarser one does not hold all of
// the finer one; rolled about the sun's rays.
std::vector<glm::mat4> slices(const glm::vec3& to_light) {
  const auto slice = [&](const glm::vec3& target, float half) {
    return glm::orthoRH_ZO(-half, half, -half, half, 1.0f, 60.0f) *
           glm::lookAt(target + 30.0f * to_light, target, glm::vec3(0.4f, 1, 0.2f));
  };
  return {slice({0, 0, 3}, 3), slice({0, 0, -1}, 6)};
}

class ShadowMatrices : public TriangleTest {
 protected:
  // The scene's shadow, from maps that are drawn with these matrices.
  Shadowed draw_with(const std::vector<glm::mat4>& matrices, const std::string& technique) {
    const gl::Texture maps("engine's maps", {.target = GL_TEXTURE_2D_ARRAY,
                                             .format = GL_DEPTH_COMPONENT32F,
                                             .width = size,
                                             .height = size,
                                             .layers = static_cast<int>(matrices.size())});
    const Geometry casters(scene_);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
      gl::Pass pass(renderer_->device(),
                    {.name = "engine's maps",
                     .depth = gl::Attachment{.texture = &maps, .layer = static_cast<int>(i), .clear = glm::vec4(1)},
                     .depth_test = gl::DepthTest::less,
                     .depth_write = true});
      casters.casters()({.kind = shadow::CasterKind::depth,
                         .layer = static_cast<int>(i),
                         .world_to_clip = matrices[i],
                         .cull = {},
                         .source = shadow::Sun{scene_.to_light}},
                        pass);
    }
    const shadow::LightProjection projection = shadow::sun_projection(
        {.world_to_clip = matrices, .to_light = scene_.to_light, .size = size, .camera = glm::vec3(2, 5, 6)});
    const shadow::Light light{.source = shadow::Sun{scene_.to_light},
                              .maps = shadow::FinishedMaps{{maps.id(), size, size}, projection}};
    return render(technique, [&](shadow::Inputs& inputs) {
      inputs.lights = {&light, 1};
      inputs.draw = {};
    });
  }

  Shadowed render(const std::string& technique, const TriangleRenderer::Adjust& adjust = {}) {
    ParamSet params = renderer_->params();
    params.set("technique", technique);
    params.set("sun.angle", 6.0f);
    params.set("cascades.size", size);
    return renderer_->render(scene_, params, adjust);
  }

  TriangleScene scene_ = box_on_ground(192);
};

TEST_F(ShadowMatrices, OfTheEnginesOwnGiveTheSameShadows) {
  for (const char* technique : {"pcss", "slices"}) {
    const Shadowed own = render(technique), given = draw_with(slices(scene_.to_light), technique);
    int different = 0, dark = 0, penumbra = 0;
    for (std::size_t i = 0; i < own.depth.size(); ++i) {
      const float a = own.mask[4 * i], b = given.mask[4 * i];
      different += std::abs(a - b) > 0.25f ? 1 : 0;
      dark += b < 0.01f ? 1 : 0;
      penumbra += b > 0.1f && b < 0.9f ? 1 : 0;
    }
    EXPECT_LE(different, 8) << technique;
    EXPECT_GT(dark, 500) << technique;
    EXPECT_GT(penumbra, 200) << technique;
  }
}

}  // namespace
}  // namespace penumbra::test

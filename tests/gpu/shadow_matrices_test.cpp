// Shadow maps that an engine draws with matrices of its own give the shadows of the library's own maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "core/error.h"
#include "gpu/triangle_scene.h"
#include "shadow/light_matrices.h"

namespace penumbra::test {
namespace {

constexpr int size = 1024;

// Slices of the view as engines fit them, neither of which holds the other, and a map that holds both; rolled about the
// sun's rays.
std::vector<glm::mat4> slices(const glm::vec3& to_light) {
  const auto slice = [&](const glm::vec3& target, float half, float away) {
    return glm::orthoRH_ZO(-half, half, -half, half, 1.0f, 2 * away) *
           glm::lookAt(target + away * to_light, target, glm::vec3(0.4f, 1, 0.2f));
  };
  return {slice({0, 0, 3}, 3, 30), slice({0, 0, -1}, 3.5f, 30), slice({0, 0, 0}, 9, 40)};
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
    params.set("sun.shape", shape_);
    return renderer_->render(scene_, params, adjust);
  }

  TriangleScene scene_ = box_on_ground(192);
  std::string shape_ = "disc";
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

TEST_F(ShadowMatrices, TurnedOnesDoNotServeASquareSun) {
  shape_ = "square";
  try {
    draw_with(slices(scene_.to_light), "pcss");
    FAIL() << "nothing thrown";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "soft shadows: the maps of light 0 are turned about its rays, which a square sun does not allow");
  }
}

}  // namespace
}  // namespace penumbra::test

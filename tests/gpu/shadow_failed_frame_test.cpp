// A frame that ends in an error leaves nothing behind that a later frame would take for its own.

#include <string>
#include <vector>

#include "core/error.h"
#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

class ShadowFailedFrame : public TriangleTest {};

// The second light's parameters were read, but it was not drawn.
TEST_F(ShadowFailedFrame, LightsThatItDidNotReachAreDrawnAsIfItHadNotBeen) {
  const TriangleScene scene = box_on_ground(64);
  std::vector<shadow::Light> lights(2);
  lights[1].id = 1;
  for (shadow::Light& light : lights) light.source = shadow::Sun{.to_light = scene.to_light};
  const auto both = [&](shadow::Inputs& in) {
    in.lights = lights;
    in.view.last_view = in.view.view;
    in.view.last_projection = in.view.projection;
  };
  const auto second_mask = [](TriangleRenderer& renderer) {
    return gl::read_floats(*renderer.mask().texture, 4, 0, /*layer=*/1);
  };
  ParamSet params = renderer_->params();
  params.set("technique", std::string("pcss"));
  params.set("cascades.size", 256);
  renderer_->render(scene, params, both);

  params.set("cascades.size", 1024);
  const std::string message = message_of([&] {
    renderer_->render(scene, params, [&](shadow::Inputs& in) {
      both(in);
      in.draw = [](const shadow::CasterPass&, gl::Pass&) { fail("the caller's fault"); };
    });
  });
  EXPECT_EQ(message, "the caller's fault");
  renderer_->render(scene, params, both);

  TriangleRenderer fresh;
  fresh.render(scene, params, both);
  EXPECT_EQ(second_mask(*renderer_), second_mask(fresh));
}

}  // namespace
}  // namespace penumbra::test

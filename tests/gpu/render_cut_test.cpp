// A technique's history is kept between the frames of one scene, and discarded at a cut.

#include <limits>

#include "gpu/render_scenes.h"

namespace penumbra::test {
namespace {

constexpr const char* technique_text = R"(
#include "shadow/light.glsl"
float read_radius(Receiver receiver, Light light) { return 0.0; }
Visibility visibility(Receiver receiver, Light light) { return Visibility(1.0, 0.0, 0.0, false, false); }
)";

// Counts the frames in a row that have had a history at this pixel.
constexpr const char* count_text = R"(
layout(binding = 8) uniform sampler2D last;
uniform int has_last;
layout(location = 0) out vec4 now;
layout(location = 1) out vec4 mask;
void main() {
  float count = has_last != 0 ? texelFetch(last, ivec2(gl_FragCoord.xy), 0).x : 0.0;
  now = mask = vec4(count + 1.0);
}
)";

void resolve(const shadow::PassContext& work) {
  const gl::Texture& mask = work.mask();
  const shadow::History counts =
      work.history("counts", {.format = GL_RGBA16F, .width = mask.width(), .height = mask.height()});
  gl::Pass pass(work.device(), {.name = "count",
                                .colors = {{.texture = &counts.now}, {.texture = &mask, .layer = work.frame().layer}}});
  work.use(pass, "count").set("has_last", counts.valid ? 1 : 0);
  work.device().sampler({}).bind(8);
  counts.last.bind(8);
  pass.draw_full_screen();
}

shadow::Technique counting() {
  return {.name = "counting",
          .summary = "Counts frames.",
          .source = "made up",
          .glsl = "test/counting.glsl",
          .needs = {},
          .resolve = resolve,
          .programs = [](const ParamSet&) -> std::vector<gl::ProgramDesc> {
            return {{.name = "count", .vertex = "shared/full_screen.vert", .fragment = "test/counting.frag"}};
          }};
}

class RenderCut : public RenderTest {
 protected:
  RenderCut() {
    device.shaders.files().put("test/counting.glsl", technique_text);
    device.shaders.files().put("test/counting.frag", count_text);
    add_node(scene, square(), glm::mat4(1));
  }

  // Draws the next frame; returns how many frames in a row the technique has counted.
  float count(scene::GpuScene& drawn) {
    const render::Frame& frame = counter.draw(drawn, inputs, counter_params);
    return gl::read_floats(*frame.mask.texture, 1)[0];
  }

  render::Renderer counter{device, shadow::Registry({.techniques = {counting()}})};
  ParamSet counter_params{render::Renderer::params(counter.registry())};
  scene::Scene scene;
};

TEST_F(RenderCut, MemoryGoesOnWithinAScene) {
  scene::GpuScene drawn(device, scene);
  for (int i = 1; i < 5; ++i) {
    EXPECT_EQ(count(drawn), static_cast<float>(i));
    inputs.last_camera = inputs.camera;
    inputs.last_time = inputs.time;
    inputs.camera.view[3][0] += 0.1f;
    inputs.time += 0.1;
  }
}

TEST_F(RenderCut, NothingIsRememberedOverACut) {
  scene::GpuScene drawn(device, scene);
  count(drawn);
  EXPECT_EQ(count(drawn), 2);
  inputs.cut = true;
  EXPECT_EQ(count(drawn), 1);
  EXPECT_EQ(count(drawn), 1);
  inputs.cut = false;
  EXPECT_EQ(count(drawn), 2);
}

TEST_F(RenderCut, AnotherSceneIsACut) {
  scene::GpuScene first(device, scene), second(device, scene);
  count(first);
  EXPECT_EQ(count(first), 2);
  EXPECT_EQ(count(second), 1);
  EXPECT_EQ(count(second), 2);
  EXPECT_EQ(count(first), 1);
}

TEST_F(RenderCut, AnotherSceneIsACutInEveryView) {
  scene::GpuScene first(device, scene), second(device, scene);
  const auto count_in = [&](scene::GpuScene& drawn, int view) {
    inputs.view = view;
    return count(drawn);
  };
  for (int i = 1; i < 3; ++i) {
    for (const int view : {0, 1}) EXPECT_EQ(count_in(first, view), static_cast<float>(i));
  }
  for (const int view : {0, 1}) EXPECT_EQ(count_in(second, view), 1) << view;
  for (const int view : {0, 1}) EXPECT_EQ(count_in(second, view), 2) << view;
}

TEST_F(RenderCut, AnotherSceneIsACutAtTheAddressOfTheLastToo) {
  std::optional<scene::GpuScene> drawn;
  for (int i = 0; i < 3; ++i) {
    drawn.emplace(device, scene);
    EXPECT_EQ(count(*drawn), 1);
    EXPECT_EQ(count(*drawn), 2);
  }
}

TEST_F(RenderCut, AFrameThatThrowsIsNoneToGoOnFrom) {
  scene::GpuScene drawn(device, scene);
  count(drawn);
  EXPECT_EQ(count(drawn), 2);
  const float place = inputs.camera.view[3][0];
  inputs.camera.view[3][0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(count(drawn), Error);
  inputs.camera.view[3][0] = place;
  EXPECT_EQ(count(drawn), 1);
}

}  // namespace
}  // namespace penumbra::test

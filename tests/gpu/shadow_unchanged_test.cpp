// Work that a frame in which nothing changed does not repeat. render_steady_frame_test.cpp tests that such a frame
// makes no OpenGL query.

#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"
#include "shadow/light_state.h"

namespace penumbra::test {
namespace {

class ShadowUnchanged : public TriangleTest {
 protected:
  // Draws the next frame of a camera that does not move.
  void frame(const ParamSet& params, const TriangleRenderer::Adjust& adjust = {}) {
    renderer_->render(scene_, params, [&](shadow::Inputs& inputs) {
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
      if (adjust) adjust(inputs);
    });
  }

  TriangleScene scene_ = box_on_ground();
};

TEST_F(ShadowUnchanged, ATextureIsCheckedAgainWhenItIsAnother) {
  const ParamSet params = renderer_->params();
  frame(params);
  frame(params);
  const gl::Texture unsigned_normals("unsigned", {.format = GL_RG16, .width = 64, .height = 64});
  const auto with_others = [&](shadow::Inputs& inputs) { inputs.normals.id = unsigned_normals.id(); };
  for (int i = 0; i < 2; ++i) EXPECT_THROW(frame(params, with_others), Error) << "a refusal is not kept";
  EXPECT_NO_THROW(frame(params));
  EXPECT_THROW(frame(params, [](shadow::Inputs& inputs) { inputs.depth.width = 63; }), Error) << "another size";
  EXPECT_THROW(frame(params, [](shadow::Inputs& inputs) { inputs.conventions.octahedral_normals = false; }), Error)
      << "another use: three channels";
}

TEST_F(ShadowUnchanged, MakesNoParameterSet) {
  const ParamSet values = renderer_->params();
  const ParamSet defaults = renderer_->params();
  const shadow::GivenParams given{.registry = renderer_->shadows().registry(), .defaults = defaults, .values = values};
  shadow::LightState state;
  shadow::Light light;
  EXPECT_FALSE(shadow::take_params(state, given, light)) << "the first";
  const ParamValue* const value = &state.params.value("sun.angle");
  state.uploaded = true;
  EXPECT_TRUE(shadow::take_params(state, given, light));
  EXPECT_EQ(&state.params.value("sun.angle"), value) << "the same set";
  EXPECT_TRUE(state.uploaded);
  light.overrides = {"sun.angle=2"};
  EXPECT_FALSE(shadow::take_params(state, given, light));
  EXPECT_EQ(state.params.get_float("sun.angle"), 2.0f);
  EXPECT_FALSE(state.uploaded);
}

TEST_F(ShadowUnchanged, TellsTheForwardProgramOfTheParametersThatItIsAskedFor) {
  ParamSet params = renderer_->params();
  params.set("technique", std::string("pcf"));
  const auto taps = [&](const shadow::Light& light) {
    std::string value;
    for (const gl::Define& define : renderer_->shadows().forward_program(params, light).defines) {
      if (define.name == "pcf_filter_taps") value = define.value;
    }
    return value;
  };
  shadow::Light light;
  light.overrides = {"pcf.filter_taps=7"};
  EXPECT_EQ(taps(light), "7");
  EXPECT_EQ(taps({}), "16");
  params.set("pcf.filter_taps", 9);
  EXPECT_EQ(taps({}), "9");
  EXPECT_EQ(taps(light), "7");
}

TEST_F(ShadowUnchanged, PutsNoGeneratedFile) {
  ParamSet params = renderer_->params();
  renderer_->shadows().registry().select(params, "thesis");
  frame(params);
  gl::ShaderFiles& files = renderer_->device().shaders.files();
  const std::vector<std::string> generated{
      "generated/registry0/techniques/pcss/mask.frag",
      "generated/registry0/denoisers/history_and_filters/shadow/drivers/history.frag",
      "generated/registry0/shadow/filters/median.glsl/shadow/drivers/filter.frag"};
  for (const std::string& file : generated) {
    ASSERT_TRUE(files.read(file)) << file;
    files.put(file, "left alone");
  }
  frame(params);
  for (const std::string& file : generated) EXPECT_EQ(files.read(file), "left alone");
}

}  // namespace
}  // namespace penumbra::test

// What a frame in which nothing changed does not do again.

#include <glm/gtc/matrix_transform.hpp>

#include "gl/api.h"
#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"
#include "shadow/light_state.h"

namespace penumbra::test {
namespace {

int questions = 0;  // to OpenGL

// Counts the calls of a function of OpenGL while it lives.
template <auto& Pointer>
class Counted {
  using Function = std::remove_reference_t<decltype(Pointer)>;

  template <class R, class... A>
  static R count(A... arguments) {
    ++questions;
    return original(arguments...);
  }
  template <class R, class... A>
  static Function counting(R (*)(A...)) {
    return count<R, A...>;
  }
  static inline Function original = nullptr;

 public:
  Counted() {
    original = Pointer;
    Pointer = counting(Pointer);
  }
  ~Counted() { Pointer = original; }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
};

class ShadowUnchanged : public TriangleTest {
 protected:
  // The next frame of a camera that stands still.
  void frame(const ParamSet& params, const TriangleRenderer::Adjust& adjust = {}) {
    renderer_->render(scene_, params, [&](shadow::Inputs& inputs) {
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
      inputs_ = inputs;
      if (adjust) adjust(inputs);
    });
  }

  TriangleScene scene_ = box_on_ground();
  shadow::Inputs inputs_;
};

// Without the questions that the test's own drawing and reading back ask.
int questions_of(TriangleRenderer& renderer, const TriangleScene& scene, const ParamSet& params) {
  int asked = 0;
  renderer.render(scene, params, [&](shadow::Inputs& inputs) {
    const Counted<gl::glIsTexture> a;
    const Counted<gl::glGetTextureParameteriv> b;
    const Counted<gl::glGetTextureLevelParameteriv> c;
    const Counted<gl::glGetIntegerv> d;
    const Counted<gl::glGetIntegeri_v> e;
    const Counted<gl::glGetFloatv> f;
    const Counted<gl::glIsEnabled> g;
    const Counted<gl::glGetProgramiv> h;
    const Counted<gl::glGetUniformLocation> i;
    const Counted<gl::glCheckNamedFramebufferStatus> j;
    questions = 0;
    renderer.shadows().render(inputs, params);
    asked = questions;
  });
  return asked;
}

TEST_F(ShadowUnchanged, AsksOpenGLNothing) {
  for (const char* technique : {"hard", "pcss", "thesis", "thesis_compute"}) {
    ParamSet params = renderer_->params();
    renderer_->shadows().registry().select(params, technique);
    EXPECT_GT(questions_of(*renderer_, scene_, params), 0) << technique << ": programs are made";
    questions_of(*renderer_, scene_, params);
    EXPECT_EQ(questions_of(*renderer_, scene_, params), 0) << technique;
  }
}

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
  const ParamSet given = renderer_->params();
  const ParamSet defaults = given;
  shadow::LightState state;
  shadow::Light light;
  EXPECT_FALSE(shadow::take_params(state, defaults, given, light)) << "the first";
  const ParamValue* const value = &state.params.value("sun.angle");
  state.uploaded = true;
  EXPECT_TRUE(shadow::take_params(state, defaults, given, light));
  EXPECT_EQ(&state.params.value("sun.angle"), value) << "the same set";
  EXPECT_TRUE(state.uploaded);
  light.overrides = {"sun.angle=2"};
  EXPECT_FALSE(shadow::take_params(state, defaults, given, light));
  EXPECT_EQ(state.params.get_float("sun.angle"), 2.0f);
  EXPECT_FALSE(state.uploaded);
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

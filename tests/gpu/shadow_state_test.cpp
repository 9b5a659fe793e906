// The library in an engine: whatever state it comes in, the mask is the same, and what is left is what the header says.

#include <array>
#include <glm/gtc/matrix_transform.hpp>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr std::array<GLenum, 29> capabilities{GL_DEPTH_TEST,
                                              GL_STENCIL_TEST,
                                              GL_SCISSOR_TEST,
                                              GL_BLEND,
                                              GL_COLOR_LOGIC_OP,
                                              GL_CULL_FACE,
                                              GL_DEPTH_CLAMP,
                                              GL_FRAMEBUFFER_SRGB,
                                              GL_RASTERIZER_DISCARD,
                                              GL_SAMPLE_MASK,
                                              GL_SAMPLE_COVERAGE,
                                              GL_SAMPLE_SHADING,
                                              GL_SAMPLE_ALPHA_TO_COVERAGE,
                                              GL_SAMPLE_ALPHA_TO_ONE,
                                              GL_LINE_SMOOTH,
                                              GL_POLYGON_SMOOTH,
                                              GL_POLYGON_OFFSET_FILL,
                                              GL_PRIMITIVE_RESTART,
                                              GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                              GL_PROGRAM_POINT_SIZE,
                                              GL_CLIP_DISTANCE0,
                                              GL_CLIP_DISTANCE0 + 1,
                                              GL_CLIP_DISTANCE0 + 2,
                                              GL_CLIP_DISTANCE0 + 3,
                                              GL_CLIP_DISTANCE0 + 4,
                                              GL_CLIP_DISTANCE0 + 5,
                                              GL_CLIP_DISTANCE0 + 6,
                                              GL_CLIP_DISTANCE0 + 7,
                                              GL_DITHER};

template <std::size_t count = 1>
std::array<GLint, count> integers(GLenum name) {
  std::array<GLint, 16> values{};
  gl::glGetIntegerv(name, values.data());
  std::array<GLint, count> result{};
  std::copy_n(values.begin(), count, result.begin());
  return result;
}

// State that no engine has all of at once, and each of which would spoil a pass that inherited it.
class Disturbed {
 public:
  Disturbed() {
    gl::glCreateVertexArrays(1, &vertex_array_);
    gl::glBindVertexArray(vertex_array_);
    for (const GLenum capability : capabilities) gl::glEnable(capability);
    gl::glDisable(GL_DITHER);
    gl::glScissor(0, 0, 1, 1);
    gl::glViewport(3, 3, 1, 1);
    gl::glStencilFunc(GL_NEVER, 1, 0xff);
    gl::glStencilOp(GL_INCR, GL_INCR, GL_INCR);
    gl::glStencilMask(0x0f);
    gl::glBlendFunc(GL_ZERO, GL_ZERO);
    gl::glLogicOp(GL_CLEAR);
    gl::glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
    gl::glDepthMask(GL_FALSE);
    gl::glDepthFunc(GL_NEVER);
    gl::glDepthRange(1.0, 0.0);
    gl::glFrontFace(GL_CW);
    gl::glCullFace(GL_FRONT_AND_BACK);
    gl::glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    gl::glPolygonOffset(1e6f, 1e6f);
    gl::glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    gl::glSampleCoverage(0.0f, GL_FALSE);
    gl::glSampleMaski(0, 0);
    gl::glMinSampleShading(1.0f);
    gl::glPrimitiveRestartIndex(0);
    gl::glPointSize(5.0f);
    for (GLuint unit = 0; unit < 16; ++unit) {
      // A comparing, filtering sampler gives other values for every texture.
      sampler_.bind(unit);
      gl::glBindTextureUnit(unit, texture_.id());
    }
  }
  ~Disturbed() { gl::glDeleteVertexArrays(1, &vertex_array_); }
  Disturbed(const Disturbed&) = delete;
  Disturbed& operator=(const Disturbed&) = delete;

 private:
  GLuint vertex_array_ = 0;
  gl::Texture texture_{"other", {.format = GL_DEPTH_COMPONENT32F}};
  gl::Sampler sampler_{"other", {.min_filter = GL_LINEAR, .mag_filter = GL_LINEAR, .compare = true}};
};

void expect_documented_state() {
  for (const GLenum capability : capabilities) {
    EXPECT_EQ(gl::glIsEnabled(capability), capability == GL_DITHER ? GL_TRUE : GL_FALSE) << std::hex << capability;
  }
  EXPECT_EQ(integers(GL_DEPTH_FUNC)[0], GL_LESS);
  EXPECT_EQ(integers(GL_DEPTH_WRITEMASK)[0], GL_TRUE);
  for (const GLenum function : {GL_STENCIL_FUNC, GL_STENCIL_BACK_FUNC}) EXPECT_EQ(integers(function)[0], GL_ALWAYS);
  for (const GLenum mask : {GL_STENCIL_WRITEMASK, GL_STENCIL_BACK_WRITEMASK, GL_STENCIL_VALUE_MASK}) {
    EXPECT_EQ(integers(mask)[0] & 0xff, 0xff);
  }
  EXPECT_EQ(integers(GL_STENCIL_PASS_DEPTH_PASS)[0], GL_KEEP);
  EXPECT_EQ(integers<4>(GL_COLOR_WRITEMASK), (std::array<GLint, 4>{1, 1, 1, 1}));
  EXPECT_EQ(integers(GL_FRONT_FACE)[0], GL_CCW);
  EXPECT_EQ(integers(GL_CULL_FACE_MODE)[0], GL_BACK);
  EXPECT_EQ(integers(GL_POLYGON_MODE)[0], GL_FILL);
  EXPECT_EQ(integers(GL_CLIP_ORIGIN)[0], GL_LOWER_LEFT);
  EXPECT_EQ(integers(GL_CLIP_DEPTH_MODE)[0], GL_NEGATIVE_ONE_TO_ONE);
  EXPECT_EQ(integers(GL_POINT_SIZE)[0], 1);
  std::array<GLfloat, 2> range{};
  gl::glGetFloatv(GL_DEPTH_RANGE, range.data());
  EXPECT_EQ(range, (std::array<GLfloat, 2>{0, 1}));
  for (const GLenum binding :
       {GL_CURRENT_PROGRAM, GL_VERTEX_ARRAY_BINDING, GL_DRAW_FRAMEBUFFER_BINDING, GL_READ_FRAMEBUFFER_BINDING,
        GL_DRAW_INDIRECT_BUFFER_BINDING, GL_DISPATCH_INDIRECT_BUFFER_BINDING}) {
    EXPECT_EQ(integers(binding)[0], 0) << std::hex << binding;
  }
  for (GLuint unit = 0; unit < 16; ++unit) {
    for (const GLenum binding : {GL_SAMPLER_BINDING, GL_TEXTURE_BINDING_2D, GL_TEXTURE_BINDING_2D_ARRAY}) {
      GLint bound = -1;
      gl::glGetIntegeri_v(binding, unit, &bound);
      EXPECT_EQ(bound, 0) << "unit " << unit;
    }
  }
  for (GLuint unit = 0; unit < 8; ++unit) {
    GLint bound = -1;
    gl::glGetIntegeri_v(GL_IMAGE_BINDING_NAME, unit, &bound);
    EXPECT_EQ(bound, 0) << "image unit " << unit;
  }
}

class ShadowState : public GpuTest {
 protected:
  void TearDown() override {
    gl::leave_initial_state();
    GpuTest::TearDown();
  }
};

TEST_F(ShadowState, NothingIsInheritedAndWhatIsLeftIsDocumented) {
  TriangleRenderer renderer;
  TriangleScene scene;
  scene.add_quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  scene.add_box({-1, 0, -1}, {1, 1, 1});
  scene.view = glm::lookAt(glm::vec3(2, 5, 6), glm::vec3(0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.8f, 1, 0.1f);
  scene.to_light = sun_direction(60, 40);
  ParamSet params = renderer.params();
  params.set("sun.angle", 4.0f);
  for (const std::string technique : {"none", "pcss"}) {
    for (const std::string driver : {"fragment", "compute"}) {
      SCOPED_TRACE(technique);
      SCOPED_TRACE(driver);
      params.set("technique", technique);
      params.set("driver", driver);
      const Shadowed clean = renderer.render(scene, params);
      std::optional<Disturbed> disturbed;
      const Shadowed after = renderer.render(scene, params, [&](shadow::Inputs&) { disturbed.emplace(); });
      EXPECT_EQ(after.mask, clean.mask);
      expect_documented_state();
      EXPECT_EQ(integers<4>(GL_SCISSOR_BOX), (std::array<GLint, 4>{0, 0, 1, 1})) << "what is not listed stays";
      EXPECT_EQ(integers(GL_LOGIC_OP_MODE)[0], GL_CLEAR);
    }
  }
}

}  // namespace
}  // namespace penumbra::test

// The library in an engine: the mask does not depend on the OpenGL state before the call, and the state after it is
// what the header promises.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <utility>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr std::array<GLenum, 31> capabilities{GL_DEPTH_TEST,
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
                                              GL_POLYGON_OFFSET_LINE,
                                              GL_POLYGON_OFFSET_POINT,
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

// State that render() does not change, with values that an engine may have set: each differs from the initial one.
struct Kept {
  GLenum name;
  GLint value;
};
constexpr std::array kept_layout{
    Kept{GL_UNPACK_ALIGNMENT, 8},   Kept{GL_UNPACK_ROW_LENGTH, 17}, Kept{GL_UNPACK_SKIP_ROWS, 2},
    Kept{GL_UNPACK_SKIP_PIXELS, 3}, Kept{GL_UNPACK_SKIP_IMAGES, 1}, Kept{GL_UNPACK_IMAGE_HEIGHT, 19},
    Kept{GL_UNPACK_SWAP_BYTES, 1},  Kept{GL_PACK_ALIGNMENT, 2},     Kept{GL_PACK_ROW_LENGTH, 23},
    Kept{GL_PACK_SKIP_ROWS, 4},     Kept{GL_PACK_SKIP_PIXELS, 5},   Kept{GL_PACK_SKIP_IMAGES, 6},
    Kept{GL_PACK_IMAGE_HEIGHT, 29}, Kept{GL_PACK_SWAP_BYTES, 1}};
// Bindings of buffers that render() does not change: the target, and the query that returns the binding.
constexpr std::array kept_buffers{std::pair{GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING},
                                  std::pair{GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING},
                                  std::pair{GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING},
                                  std::pair{GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER},
                                  std::pair{GL_COPY_WRITE_BUFFER, GL_COPY_WRITE_BUFFER},
                                  std::pair{GL_TEXTURE_BUFFER, GL_TEXTURE_BUFFER_BINDING},
                                  std::pair{GL_QUERY_BUFFER, GL_QUERY_BUFFER_BINDING}};

constexpr GLuint kept_storage = 7;  // bindings of storage buffers, from 0 on

// State that no engine has all at once. Some of it would break a pass that inherited it; render() must not change the
// rest.
class Disturbed {
 public:
  Disturbed() {
    gl::glCreateVertexArrays(1, &vertex_array_);
    gl::glBindVertexArray(vertex_array_);
    for (const GLenum capability : capabilities) gl::glEnable(capability);
    gl::glDisable(GL_DITHER);
    for (GLuint viewport = 0; viewport < 16; ++viewport)
      gl::glScissorIndexed(viewport, static_cast<GLint>(viewport), 0, 1, 1);
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
    for (const Kept& kept : kept_layout) gl::glPixelStorei(kept.name, kept.value);
    for (const auto& [target, query] : kept_buffers) gl::glBindBuffer(target, buffer_.id());
    gl::glBindBufferBase(GL_UNIFORM_BUFFER, 3, buffer_.id());
    for (GLuint i = 0; i < kept_storage; ++i) gl::glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffer_.id());
    gl::glActiveTexture(GL_TEXTURE5);
    gl::glClearColor(0.25f, 0.5f, 0.75f, 1.0f);
    gl::glBlendColor(0.25f, 0.5f, 0.75f, 1.0f);
    gl::glProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    for (GLuint unit = 0; unit < 16; ++unit) {
      // A sampler that compares and filters, with which every texture would return other values.
      sampler_.bind(unit);
      gl::glBindTextureUnit(unit, texture_.id());
    }
  }
  ~Disturbed() {
    gl::glDeleteVertexArrays(1, &vertex_array_);
    for (const Kept& kept : kept_layout) {
      const bool alignment = kept.name == GL_UNPACK_ALIGNMENT || kept.name == GL_PACK_ALIGNMENT;
      gl::glPixelStorei(kept.name, alignment ? 4 : 0);
    }
    gl::glActiveTexture(GL_TEXTURE0);
    gl::glProvokingVertex(GL_LAST_VERTEX_CONVENTION);
  }
  Disturbed(const Disturbed&) = delete;
  Disturbed& operator=(const Disturbed&) = delete;

  void expect_kept() const {
    const auto id = static_cast<GLint>(buffer_.id());
    for (const Kept& kept : kept_layout) EXPECT_EQ(integers(kept.name)[0], kept.value) << std::hex << kept.name;
    for (const auto& [target, query] : kept_buffers) EXPECT_EQ(integers(query)[0], id) << std::hex << target;
    GLint bound = 0;
    gl::glGetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 3, &bound);
    EXPECT_EQ(bound, id);
    for (GLuint i = 0; i < kept_storage; ++i) {
      gl::glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, i, &bound);
      EXPECT_EQ(bound, id) << "storage buffer " << i;
    }
    EXPECT_EQ(integers(GL_ACTIVE_TEXTURE)[0], GL_TEXTURE5);
    EXPECT_EQ(integers(GL_PROVOKING_VERTEX)[0], GL_FIRST_VERTEX_CONVENTION);
    EXPECT_EQ(integers(GL_LOGIC_OP_MODE)[0], GL_CLEAR);
    for (GLuint viewport = 1; viewport < 16; ++viewport) {
      std::array<GLint, 4> box{};
      gl::glGetIntegeri_v(GL_SCISSOR_BOX, viewport, box.data());
      EXPECT_EQ(box, (std::array<GLint, 4>{static_cast<GLint>(viewport), 0, 1, 1})) << viewport;
    }
    for (const GLenum color : {GL_COLOR_CLEAR_VALUE, GL_BLEND_COLOR}) {
      std::array<GLfloat, 4> values{};
      gl::glGetFloatv(color, values.data());
      EXPECT_EQ(values, (std::array<GLfloat, 4>{0.25f, 0.5f, 0.75f, 1.0f})) << std::hex << color;
    }
  }

 private:
  GLuint vertex_array_ = 0;
  gl::Buffer buffer_{"other", 1024};
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

// A wide sun over a box, a corner of which moves where a history is kept.
TriangleScene small_scene() {
  TriangleScene scene;
  scene.add_quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10});
  scene.add_box({-1, 0, -1}, {1, 1, 1});
  scene.move_from(12, {0.1f, 0, 0});
  scene.view = glm::lookAt(glm::vec3(2, 5, 6), glm::vec3(0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.8f, 1, 0.1f);
  scene.to_light = sun_direction(60, 40);
  scene.width = scene.height = 16;
  return scene;
}

ParamSet small_params(const TriangleRenderer& renderer) {
  ParamSet params = renderer.params();
  params.set("sun.angle", 4.0f);
  params.set("cascades.size", 64);
  params.set("cascades.count", 2);
  return params;
}

// The provoking vertex is the caller's state, and on a software rasteriser it is the vertex from which depth is
// interpolated. So depths may be rounded in another way, and a mask's values may differ by one step of half floats.
void expect_equal_but_for_rounding(const std::vector<float>& mask, const std::vector<float>& expected) {
  ASSERT_EQ(mask.size(), expected.size());
  for (std::size_t i = 0; i < mask.size(); ++i) {
    ASSERT_NEAR(mask[i], expected[i], std::ldexp(std::abs(expected[i]), -10)) << i;
  }
}

class ShadowState : public GpuTest {
 protected:
  void TearDown() override {
    gl::leave_initial_state();
    GpuTest::TearDown();
  }

  // Draws the same frame in a clean OpenGL state and in one that an engine has changed, each with a separate renderer.
  void expect_promises(TriangleRenderer& clean, TriangleRenderer& disturbed, const ParamSet& params) {
    shadow::Light light;
    const auto with_memory = [&](shadow::Inputs& inputs) {
      if (output) {
        light = inputs.lights[0];
        light.output = output;
        inputs.lights = {&light, 1};
        gl::glClearTexImage(output->id, 0, GL_RED, GL_FLOAT, nullptr);
      }
      inputs.view.last_view = scene.view;
      inputs.view.last_projection = scene.projection;
    };
    const Shadowed expected = clean.render(scene, params, with_memory);
    std::optional<Disturbed> state;
    const Shadowed drawn = disturbed.render(
        scene, params,
        [&](shadow::Inputs& inputs) {
          with_memory(inputs);
          state.emplace();
        },
        [&] {
          expect_documented_state();
          state->expect_kept();
        });
    expect_equal_but_for_rounding(drawn.mask, expected.mask);
  }

  const TriangleScene scene = small_scene();
  std::optional<shadow::OutputTexture> output;  // of the light
};

TEST_F(ShadowState, AFirstFrameUploadsNoiseAndKeepsWhatIsNotListed) {
  for (const std::string driver : {"fragment", "compute"}) {
    SCOPED_TRACE(driver);
    TriangleRenderer clean, disturbed;
    ParamSet params = small_params(clean);
    params.set("technique", std::string("pcss"));
    params.set("driver", driver);
    expect_promises(clean, disturbed, params);
  }
}

TEST_F(ShadowState, EveryTechniqueInheritsNothingAndLeavesWhatIsDocumented) {
  TriangleRenderer clean, disturbed;
  for (const std::string& name : clean.shadows().registry().names()) {
    SCOPED_TRACE(name);
    ParamSet params = small_params(clean);
    clean.shadows().registry().select(params, name);
    for (int frame = 0; frame < 2; ++frame) expect_promises(clean, disturbed, params);
  }
}

TEST_F(ShadowState, AMaskOfFewerPixelsInheritsNothingAndLeavesWhatIsDocumented) {
  TriangleRenderer clean, disturbed;
  for (const std::string name : {"pcss", "pcss_compute", "thesis", "slices_denoised"}) {
    SCOPED_TRACE(name);
    ParamSet params = small_params(clean);
    clean.shadows().registry().select(params, name);
    params.set("mask.scale", 2);
    for (int frame = 0; frame < 2; ++frame) expect_promises(clean, disturbed, params);
  }
}

TEST_F(ShadowState, ATextureOfTheCallersIsWrittenInAnyState) {
  TriangleRenderer clean, disturbed;
  const gl::Texture texture("output", {.format = GL_RG16F, .width = scene.width, .height = scene.height});
  output = {.id = texture.id(), .channel = 1};
  for (int frame = 0; frame < 2; ++frame) {
    expect_promises(clean, disturbed, small_params(clean));
    const std::vector<float> mask = gl::read_floats(*disturbed.mask().texture, 1);
    const std::vector<float> written = gl::read_floats(texture, 2);
    for (std::size_t i = 0; i < mask.size(); ++i) {
      ASSERT_EQ(written[2 * i], 0.0f) << i;
      ASSERT_EQ(written[2 * i + 1], mask[i]) << i;
    }
  }
}

TEST_F(ShadowState, AFrameThatFailsLeavesWhatIsDocumented) {
  TriangleRenderer renderer;
  for (const std::string name : {"pcss", "pcss_compute", "shadow_volume", "thesis"}) {
    SCOPED_TRACE(name);
    ParamSet params = small_params(renderer);
    renderer.shadows().registry().select(params, name);
    std::optional<Disturbed> state;
    const std::string message = message_of([&] {
      renderer.render(scene, params, [&](shadow::Inputs& inputs) {
        state.emplace();
        inputs.draw = [](const shadow::CasterPass&, gl::Pass&) { fail("the caller's fault"); };
      });
    });
    EXPECT_EQ(message, "the caller's fault");
    expect_documented_state();
    state->expect_kept();
  }
}

TEST_F(ShadowState, AWarmUpThatFailsLeavesWhatIsDocumented) {
  TriangleRenderer renderer;
  const shadow::Light light{.overrides = {"technique=unknown"}, .maps = {}};
  const Disturbed state;
  message_of([&] { renderer.shadows().warm_up({.lights = {&light, 1}}, renderer.params()); });
  expect_documented_state();
  state.expect_kept();
}

// Every switch and every choice among the library's parameters; together they select each filter, noise, pattern,
// movement map and driver.
TEST_F(ShadowState, SoDoesEveryChoiceOfTheLibrary) {
  TriangleRenderer clean, disturbed;
  const std::vector<std::string> techniques = clean.shadows().registry().names();
  const ParamSet defaults = clean.params();
  for (const Param& row : defaults.rows()) {
    const bool of_technique = std::ranges::find(techniques, row.name.substr(0, row.name.find('.'))) != techniques.end();
    const bool is_choice = !row.choices.empty() || std::holds_alternative<bool>(row.default_value);
    if (of_technique || !is_choice) continue;
    for (const std::string driver : {"fragment", "compute"}) {
      for (const ParamValue& value : representative_values(row)) {
        SCOPED_TRACE(row.name + "=" + to_text(value) + " " + driver);
        ParamSet params = small_params(clean);
        params.set("technique", std::string("pcss"));
        params.set("history.reuse", true);
        params.set("driver", driver);
        params.set(row.name, value);
        for (int frame = 0; frame < 2; ++frame) expect_promises(clean, disturbed, params);
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::test

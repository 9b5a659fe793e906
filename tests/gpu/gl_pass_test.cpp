#include "gl/pass.h"

#include "gl/api.h"
#include "gl_pass.h"

namespace penumbra {
namespace {

using test::color_program;
using test::fill_program;

using GlPass = test::GlPassTest;

// State that an engine may leave behind, and that no pass may inherit.
void disturb_state() {
  gl::glEnable(GL_SCISSOR_TEST);
  gl::glScissor(0, 0, 1, 1);
  gl::glViewport(0, 0, 1, 1);
  gl::glColorMask(GL_FALSE, GL_TRUE, GL_FALSE, GL_FALSE);
  gl::glDepthMask(GL_FALSE);
  gl::glEnable(GL_BLEND);
  gl::glBlendFunc(GL_ZERO, GL_ZERO);
  gl::glEnable(GL_CULL_FACE);
  gl::glCullFace(GL_FRONT_AND_BACK);
  gl::glFrontFace(GL_CW);
  gl::glEnable(GL_DEPTH_TEST);
  gl::glDepthFunc(GL_NEVER);
  gl::glClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl::glDepthRange(1.0, 0.0);
  gl::glEnable(GL_RASTERIZER_DISCARD);
  gl::glEnable(GL_STENCIL_TEST);
  gl::glStencilFunc(GL_NEVER, 0, 0);
  gl::glEnable(GL_POLYGON_OFFSET_FILL);
  gl::glEnable(GL_POLYGON_OFFSET_LINE);
  gl::glEnable(GL_POLYGON_OFFSET_POINT);
  gl::glPolygonOffset(1000.0f, 1000.0f);
  for (GLenum i = 0; i < 8; ++i) gl::glEnable(GL_CLIP_DISTANCE0 + i);
  for (const GLenum capability : {GL_SAMPLE_COVERAGE, GL_SAMPLE_SHADING, GL_SAMPLE_ALPHA_TO_ONE,
                                  GL_SAMPLE_ALPHA_TO_COVERAGE, GL_SAMPLE_MASK, GL_LINE_SMOOTH, GL_POLYGON_SMOOTH}) {
    gl::glEnable(capability);
  }
  gl::glSampleCoverage(0.0f, GL_FALSE);
  gl::glSampleMaski(0, 0);
  gl::glBindVertexArray(0);
}

TEST_F(GlPass, InheritsNoState) {
  disturb_state();
  draw({.name = "p",
        .colors = {{.texture = &color, .clear = glm::vec4(9)}},
        .depth = gl::Attachment{.texture = &depth, .clear = glm::vec4(1)},
        .depth_test = gl::DepthTest::less_equal,
        .depth_write = true,
        .cull_back = true},
       {1, 2, 3, 4});
  EXPECT_EQ(gl::read_floats(color, 4), (std::vector<float>{1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4}));
  EXPECT_EQ(gl::read_floats(depth, 1), (std::vector<float>(4, 0.5f)));
}

TEST_F(GlPass, ScissorsLimitDrawsAndNoClears) {
  draw({.name = "p",
        .colors = {{.texture = &color, .clear = glm::vec4(9)}},
        .scissor = gl::TexelRect{.x = 1, .y = 0, .width = 1, .height = 1}},
       {1, 2, 3, 4});
  EXPECT_EQ(gl::read_floats(color, 4), (std::vector<float>{9, 9, 9, 9, 1, 2, 3, 4, 9, 9, 9, 9, 9, 9, 9, 9}));
  draw({.name = "p", .colors = {{.texture = &color}}}, {1, 2, 3, 4});
  EXPECT_EQ(gl::read_floats(color, 4), (std::vector<float>{1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4, 1, 2, 3, 4}));
}

TEST_F(GlPass, ClearsReachFloatsAndBothKindsOfIntegers) {
  const gl::Texture& uints = device.target("uints", {.format = GL_RG32UI});
  const gl::Texture& ints = device.target("ints", {.format = GL_R32I});
  const gl::Texture& floats = device.target("floats", {.format = GL_R32F});
  disturb_state();
  test::clear(device, {.name = "clear",
                       .colors = {{.texture = &uints, .clear = glm::vec4(70000, 3, 0, 0)},
                                  {.texture = &ints, .clear = glm::vec4(-5)},
                                  {.texture = &floats, .clear = glm::vec4(-0.5f)}}});
  EXPECT_EQ(gl::read_uints(uints, 2), (std::vector<unsigned>{70000u, 3u}));
  GLint stored = 0;
  gl::glGetTextureImage(ints.id(), 0, GL_RED_INTEGER, GL_INT, sizeof(stored), &stored);
  EXPECT_EQ(stored, -5);
  EXPECT_EQ(gl::read_floats(floats, 1).front(), -0.5f);
}

TEST_F(GlPass, WithoutAClearContentsStay) {
  test::clear(device, {.name = "clear", .colors = {{.texture = &color, .clear = glm::vec4(7)}}});
  test::clear(device, {.name = "load", .colors = {{.texture = &color}}});
  EXPECT_EQ(gl::read_floats(color, 4).front(), 7.0f);
}

TEST_F(GlPass, DepthTestsCompareAsNamed) {
  struct Case {
    gl::DepthTest test;
    float stored;
    bool passes;
  };
  for (const Case& c : {Case{gl::DepthTest::less_equal, 0.6f, true}, Case{gl::DepthTest::less_equal, 0.4f, false},
                        Case{gl::DepthTest::greater_equal, 0.4f, true}, Case{gl::DepthTest::greater_equal, 0.6f, false},
                        Case{gl::DepthTest::equal, 0.5f, true}, Case{gl::DepthTest::equal, 0.4f, false},
                        Case{gl::DepthTest::off, 0.1f, true}}) {
    draw({.name = "p",
          .colors = {{.texture = &color, .clear = glm::vec4(0)}},
          .depth = gl::Attachment{.texture = &depth, .clear = glm::vec4(c.stored)},
          .depth_test = c.test},
         glm::vec4(1));
    EXPECT_EQ(gl::read_floats(color, 4).front(), c.passes ? 1.0f : 0.0f) << c.stored;
    EXPECT_EQ(gl::read_floats(depth, 1).front(), c.stored) << "depth was not to be written";
  }
}

TEST_F(GlPass, BlendsAsNamed) {
  struct Case {
    gl::Blend blend;
    float red;
  };
  for (const Case& c : {Case{gl::Blend::off, 0.5f}, Case{gl::Blend::premultiplied_over, 0.5f + 2.0f * 0.75f},
                        Case{gl::Blend::min, 0.5f}, Case{gl::Blend::max, 2.0f}, Case{gl::Blend::add, 2.5f}}) {
    draw({.name = "p", .colors = {{.texture = &color, .clear = glm::vec4(2)}}, .blend = c.blend}, {0.5f, 0, 0, 0.25f});
    EXPECT_FLOAT_EQ(gl::read_floats(color, 4).front(), c.red);
  }
}

TEST_F(GlPass, CullingTakesCounterClockwiseAsFront) {
  // The test's triangle is counter-clockwise on the screen.
  const auto red = [&](bool clockwise) {
    gl::Pass pass(device, {.name = "p", .colors = {{.texture = &color, .clear = glm::vec4(0)}}, .cull_back = true});
    pass.use(color_program).set("value", glm::vec4(1));
    pass.set_front_clockwise(clockwise);
    pass.draw_full_screen();
    return gl::read_floats(color, 4).front();
  };
  EXPECT_EQ(red(false), 1.0f);
  EXPECT_EQ(red(true), 0.0f);
}

TEST_F(GlPass, LayersAndLevelsAreDrawnAlone) {
  const gl::Texture& array = device.target(
      "array", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = 4, .height = 4, .layers = 2, .levels = 2});
  const auto clear = [&](int level, int layer, float value) {
    test::clear(device, {.name = "clear",
                         .colors = {{.texture = &array, .level = level, .layer = layer, .clear = glm::vec4(value)}}});
  };
  clear(0, 0, 1);
  clear(0, 1, 2);
  clear(1, 0, 3);
  clear(1, 1, 4);
  draw({.name = "draw", .colors = {{.texture = &array, .level = 1, .layer = 1}}}, glm::vec4(5));
  EXPECT_EQ(gl::read_floats(array, 1, 0, 0), std::vector<float>(16, 1.0f));
  EXPECT_EQ(gl::read_floats(array, 1, 0, 1), std::vector<float>(16, 2.0f));
  EXPECT_EQ(gl::read_floats(array, 1, 1, 0), std::vector<float>(4, 3.0f));
  EXPECT_EQ(gl::read_floats(array, 1, 1, 1), std::vector<float>(4, 5.0f));
}

TEST_F(GlPass, DispatchCoversEveryInvocationAskedFor) {
  const gl::Texture& array =
      device.target("array", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = 9, .height = 5, .layers = 2});
  {
    gl::Pass pass(device, {.name = "fill"});
    pass.use(fill_program);
    array.bind_image(0, GL_WRITE_ONLY);
    pass.dispatch(9, 5, 2);
  }
  const std::vector<float> layer = gl::read_floats(array, 1, 0, 1);
  EXPECT_EQ(layer.front(), 1000.0f);
  EXPECT_EQ(layer.back(), 1048.0f);
}

}  // namespace
}  // namespace penumbra

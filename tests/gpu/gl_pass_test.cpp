#include "gl/pass.h"

#include <algorithm>
#include <numeric>

#include "gl/api.h"
#include "gpu_test.h"

namespace penumbra {
namespace {

using test::shader_files;

// The full-screen triangle at depth 0.5, and a fragment shader that writes one colour.
gl::ShaderFiles files() {
  return shader_files(
      {{"triangle.vert",
        "void main() { gl_Position = vec4(vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0, 0.5, 1.0); }\n"},
       {"color.frag", "uniform vec4 value;\nlayout(location = 0) out vec4 color;\nvoid main() { color = value; }\n"},
       {"fill.comp",
        "layout(local_size_x = 8, local_size_y = 8) in;\nlayout(r32f, binding = 0) uniform writeonly image2DArray to;\n"
        "void main() {\n  ivec3 p = ivec3(gl_GlobalInvocationID);\n"
        "  imageStore(to, p, vec4(p.x + 10 * p.y + 1000 * p.z));\n}\n"}});
}

const gl::ProgramDesc color_program{.name = "color", .vertex = "triangle.vert", .fragment = "color.frag"};
const gl::ProgramDesc fill_program{.name = "fill", .compute = "fill.comp"};

class GlPass : public test::GpuTest {
 protected:
  void draw(const gl::PassDesc& desc, const glm::vec4& value) {
    gl::Pass pass(device, desc);
    pass.use(color_program).set("value", value);
    pass.draw_full_screen();
  }

  gl::Device device{files(), gl::Timers::Mode::off};
  const gl::Texture& color = device.target("color", {.format = GL_RGBA32F, .width = 2, .height = 2});
  const gl::Texture& depth = device.target("depth", {.format = GL_DEPTH_COMPONENT32F, .width = 2, .height = 2});
};

// What an engine may leave behind; a pass must not care.
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
  // The test's triangle runs counter-clockwise on the screen.
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

class GlDevice : public GlPass {
 protected:
  // Names of every kind the driver has given out, up to a bound far above what the tests make.
  static int live_objects() {
    int live = 0;
    for (GLuint id = 1; id < 2000; ++id) {
      live += gl::glIsTexture(id) + gl::glIsBuffer(id) + gl::glIsFramebuffer(id) + gl::glIsVertexArray(id) +
              gl::glIsSampler(id) + gl::glIsProgram(id) + gl::glIsShader(id) + gl::glIsQuery(id);
    }
    return live;
  }
};

TEST_F(GlDevice, AFrameMakesNoObjectsAfterTheFirst) {
  const auto frame = [&] {
    const gl::TextureDesc desc{
        .target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = 16, .height = 16, .layers = 4};
    const gl::Texture& maps = device.target("maps", desc);
    for (int layer = 0; layer < 4; ++layer) {
      draw({.name = "map", .colors = {{.texture = &maps, .layer = layer, .clear = glm::vec4(1)}}}, glm::vec4(1));
    }
    device.scratch("lists", 256);
    device.sampler({.min_filter = GL_LINEAR}).bind(0);
    gl::Pass pass(device, {.name = "fill"});
    pass.use(fill_program);
    maps.bind_image(0, GL_WRITE_ONLY);
    pass.dispatch(16, 16, 4);
  };
  frame();
  const int live = live_objects();
  const GLuint id =
      device
          .target(
              "maps",
              device
                  .target("maps",
                          {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = 16, .height = 16, .layers = 4})
                  .desc())
          .id();
  for (int i = 0; i < 5; ++i) frame();
  EXPECT_EQ(live_objects(), live);
  EXPECT_TRUE(gl::glIsTexture(id));
}

TEST_F(GlDevice, ATargetIsMadeAgainWhenItsDescriptionChanges) {
  const int live = live_objects();
  for (const int size : {4, 8, 16, 8}) {
    const gl::Texture& target = device.target("t", {.format = GL_R32F, .width = size, .height = size});
    EXPECT_EQ(target.width(), size);
    draw({.name = "p", .colors = {{.texture = &target}}}, glm::vec4(static_cast<float>(size)));
    EXPECT_EQ(gl::read_floats(target, 1), std::vector<float>(static_cast<std::size_t>(size * size), size));
  }
  constexpr int one_of_each = 5;  // texture, framebuffer, vertex array, program; the program's shaders are gone
  EXPECT_LE(live_objects(), live + one_of_each);
}

TEST_F(GlDevice, AFramebufferIsNotReusedForATextureThatTookADeadOnesName) {
  for (float value = 1; value < 5; ++value) {
    const gl::Texture own("own", {.format = GL_R32F});
    draw({.name = "p", .colors = {{.texture = &own}}}, glm::vec4(value));
    EXPECT_EQ(gl::read_floats(own, 1).front(), value);
  }
}

TEST_F(GlDevice, ScratchGrowsAndTargetsAreCounted) {
  EXPECT_GE(device.scratch("s", 100).size(), 100u);
  EXPECT_GE(device.scratch("s", 300).size(), 300u);
  EXPECT_GE(device.scratch("s", 10).size(), 300u);
  device.target("shadow/a", {.format = GL_R32F, .width = 8});
  device.target("shadow/b", {.format = GL_R8, .width = 8});
  EXPECT_EQ(device.target_bytes("shadow/"), 32u + 8u);
  EXPECT_EQ(device.target_bytes(), 32u + 8u + color.bytes() + depth.bytes());
}

class GlTimers : public GlPass {
 protected:
  static double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

  void frames(gl::Device& timed, int count) {
    for (int i = 0; i < count; ++i) {
      timed.timers.begin_frame();
      for (const char* name : {"first", "second", "first"}) {
        const gl::Pass outer(timed, {.name = name});
        const gl::Texture& target = timed.target("t", {.format = GL_RGBA32F, .width = 256, .height = 256});
        gl::Pass pass(timed, {.name = "inner", .colors = {{.texture = &target}}});
        pass.use(color_program);
        pass.draw_full_screen();
      }
      timed.timers.end_frame();
    }
  }
};

TEST_F(GlTimers, RowsNestInOrderAndPassesFillTheFrameWithoutExceedingIt) {
  for (const gl::Timers::Mode mode : {gl::Timers::Mode::finish, gl::Timers::Mode::query}) {
    gl::Device timed(files(), mode);
    frames(timed, 4);
    const auto rows = timed.timers.rows();
    std::vector<std::string> names(rows.size());
    std::ranges::transform(rows, names.begin(), &gl::Timers::Row::name);
    ASSERT_EQ(names, (std::vector<std::string>{"first", "first/inner", "second", "second/inner", "frame"}));
    for (const auto& row : rows) EXPECT_EQ(row.milliseconds.size(), 4u) << row.name;
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_LE(rows[1].milliseconds[i], rows[0].milliseconds[i]);
      EXPECT_LE(rows[0].milliseconds[i] + rows[2].milliseconds[i], rows[4].milliseconds[i]);
    }
    EXPECT_GT(sum(rows[1].milliseconds), 0.0);
  }
}

TEST_F(GlTimers, WhatIsDrawnOutsideOfAFrameIsNotRecorded) {
  gl::Device timed(files(), gl::Timers::Mode::finish);
  test::clear(timed, {.name = "warm-up"});
  frames(timed, 1);
  for (const auto& row : timed.timers.rows()) EXPECT_NE(row.name, "warm-up");
}

TEST_F(GlTimers, AFrameThatAnExceptionLeftOpenIsDropped) {
  for (const gl::Timers::Mode mode : {gl::Timers::Mode::finish, gl::Timers::Mode::query}) {
    gl::Device timed(files(), mode);
    frames(timed, 1);
    timed.timers.begin_frame();
    test::clear(timed, {.name = "aborted"});
    frames(timed, 2);
    for (const auto& row : timed.timers.rows()) {
      EXPECT_EQ(row.milliseconds.size(), 3u) << row.name;
      EXPECT_EQ(sum(row.milliseconds) > 0.0, row.name != "aborted") << row.name;
    }
  }
}

TEST_F(GlTimers, OffRecordsNothing) {
  frames(device, 2);
  EXPECT_TRUE(device.timers.rows().empty());
}

}  // namespace
}  // namespace penumbra

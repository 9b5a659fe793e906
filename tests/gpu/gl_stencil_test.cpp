// Stencil: passes test, write, clear or keep it as their PassDesc says.
#include "gl/api.h"
#include "gl/pass.h"
#include "gl_pass.h"

namespace penumbra {
namespace {

using gl::StencilOp;
using gl::StencilTest;
using test::color_program;
using test::message_of;

class GlStencil : public test::GlPassTest {
 protected:
  // A pass over all texels at depth 0.5.
  void draw_with(const gl::Stencil& stencil, gl::DepthTest depth_test = gl::DepthTest::off,
                 std::optional<float> clear_depth = {}) {
    gl::Attachment both{.texture = &depth_stencil};
    if (clear_depth) both.clear = glm::vec4(*clear_depth);
    draw({.name = "p",
          .colors = {{.texture = &color, .clear = glm::vec4(0)}},
          .depth = both,
          .depth_test = depth_test,
          .stencil = stencil},
         glm::vec4(1));
  }
  int stored() const { return gl::read_stencil(depth_stencil).front(); }
  bool drew() const { return gl::read_floats(color, 4).front() == 1.0f; }

  const gl::Texture& depth_stencil =
      device.target("depth and stencil", {.format = GL_DEPTH32F_STENCIL8, .width = 2, .height = 2});
};

TEST_F(GlStencil, TestsCompareTheReferenceWithWhatIsStored) {
  struct Case {
    StencilTest test;
    bool less, equal, greater;  // whether a reference of 4, 5 or 6 passes where 5 is stored
  };
  for (const Case& c :
       {Case{StencilTest::always, true, true, true}, Case{StencilTest::never, false, false, false},
        Case{StencilTest::less, true, false, false}, Case{StencilTest::less_equal, true, true, false},
        Case{StencilTest::equal, false, true, false}, Case{StencilTest::not_equal, true, false, true},
        Case{StencilTest::greater_equal, false, true, true}, Case{StencilTest::greater, false, false, true}}) {
    const auto passes = [&](unsigned reference) {
      draw_with({.front = {.test = c.test}, .reference = reference, .clear = 5});
      return drew();
    };
    SCOPED_TRACE(static_cast<int>(c.test));
    EXPECT_EQ(passes(4), c.less);
    EXPECT_EQ(passes(5), c.equal);
    EXPECT_EQ(passes(6), c.greater);
  }
}

TEST_F(GlStencil, OperationsChangeWhatIsStored) {
  struct Case {
    StencilOp op;
    unsigned before;
    int after;
  };
  for (const Case& c :
       {Case{StencilOp::keep, 5, 5}, Case{StencilOp::zero, 5, 0}, Case{StencilOp::replace, 5, 9},
        Case{StencilOp::increment, 255, 255}, Case{StencilOp::increment_wrap, 255, 0}, Case{StencilOp::decrement, 0, 0},
        Case{StencilOp::decrement_wrap, 0, 255}, Case{StencilOp::invert, 0x0f, 0xf0}}) {
    draw_with({.front = {.pass = c.op}, .reference = 9, .clear = c.before});
    EXPECT_EQ(stored(), c.after) << static_cast<int>(c.op);
  }
}

TEST_F(GlStencil, WhichTestFailedChoosesTheOperation) {
  const gl::StencilFace face{.test = StencilTest::equal,
                             .fail = StencilOp::zero,
                             .depth_fail = StencilOp::increment,
                             .pass = StencilOp::decrement};
  const auto after = [&](unsigned reference, float stored_depth) {
    draw_with({.front = face, .reference = reference, .clear = 5}, gl::DepthTest::less, stored_depth);
    return stored();
  };
  EXPECT_EQ(after(4, 1.0f), 0);
  EXPECT_EQ(after(5, 0.5f), 6) << "at 0.5, which is not less than itself";
  EXPECT_EQ(after(5, 0.6f), 4);
}

TEST_F(GlStencil, BothSidesHaveOperationsOfTheirOwn) {
  const gl::Stencil stencil{
      .front = {.pass = StencilOp::increment_wrap}, .back = {.pass = StencilOp::decrement_wrap}, .clear = 7};
  draw_with(stencil);
  EXPECT_EQ(stored(), 8) << "the test's triangle is counter-clockwise";
  gl::Pass pass(device, {.name = "p", .depth = gl::Attachment{.texture = &depth_stencil}, .stencil = stencil});
  pass.use(color_program).set("value", glm::vec4(1));
  pass.set_front_clockwise(true);
  pass.draw_full_screen();
  EXPECT_EQ(stored(), 6);
}

TEST_F(GlStencil, MasksLimitWhatIsReadAndWritten) {
  draw_with({.front = {.test = StencilTest::equal, .pass = StencilOp::replace},
             .reference = 0x35,
             .read_mask = 0x0f,
             .write_mask = 0xf0,
             .clear = 0x85});
  EXPECT_TRUE(drew());
  EXPECT_EQ(stored(), 0x35) << "upper half of the reference, lower half as it was";
}

TEST_F(GlStencil, DepthAndStencilAreClearedAndKeptEachByItself) {
  draw_with({.clear = 3}, gl::DepthTest::off, 0.25f);
  draw_with({}, gl::DepthTest::off, 0.75f);
  EXPECT_EQ(stored(), 3);
  draw_with({.write_mask = 0, .clear = 200});
  EXPECT_EQ(stored(), 200) << "a clear takes no notice of the write mask";
  EXPECT_EQ(gl::read_floats(depth_stencil, 1).front(), 0.75f);
  gl::glStencilMask(0);  // as an engine may leave it
  draw_with({.clear = 4});
  EXPECT_EQ(stored(), 4);
}

TEST_F(GlStencil, APassWithoutStencilNeitherTestsNorWritesIt) {
  draw_with({.front = {.test = StencilTest::never, .fail = StencilOp::increment}, .clear = 1});
  EXPECT_FALSE(drew());
  draw({.name = "plain",
        .colors = {{.texture = &color, .clear = glm::vec4(0)}},
        .depth = gl::Attachment{.texture = &depth_stencil}},
       glm::vec4(1));
  EXPECT_TRUE(drew());
  EXPECT_EQ(stored(), 2);
}

TEST_F(GlStencil, TwentyFourBitDepthHasItToo) {
  const gl::Texture& packed = device.target("packed", {.format = GL_DEPTH24_STENCIL8, .width = 2, .height = 2});
  draw({.name = "p",
        .depth = gl::Attachment{.texture = &packed, .clear = glm::vec4(1)},
        .depth_test = gl::DepthTest::less_equal,
        .depth_write = true,
        .stencil = gl::Stencil{.front = {.pass = StencilOp::replace}, .reference = 77, .clear = 0}},
       glm::vec4(1));
  EXPECT_EQ(gl::read_stencil(packed), std::vector<std::uint8_t>(4, 77));
  EXPECT_NEAR(gl::read_floats(packed, 1).front(), 0.5f, 1e-6f);
}

TEST_F(GlStencil, ADepthTextureWithoutStencilIsAnError) {
  const auto pass = [&](const gl::PassDesc& desc) { gl::Pass(device, desc); };
  const gl::Stencil stencil;
  EXPECT_EQ(
      message_of([&] { pass({.name = "volumes", .depth = gl::Attachment{.texture = &depth}, .stencil = stencil}); }),
      "pass 'volumes': it tests stencil, and its depth texture has none");
  EXPECT_EQ(message_of([&] { pass({.name = "volumes", .colors = {{.texture = &color}}, .stencil = stencil}); }),
            "pass 'volumes': it tests stencil, and its depth texture has none");
}

}  // namespace
}  // namespace penumbra

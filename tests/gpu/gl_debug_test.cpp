#include "gl/debug.h"

#include "gl/api.h"
#include "gpu_test.h"

namespace penumbra {
namespace {

using test::message_of;

class GlDebug : public test::GpuTest {};

void make_an_error() { gl::glEnable(GL_TEXTURE_2D_ARRAY); }

TEST_F(GlDebug, AnErrorIsThrownOnceWithItsDriverMessage) {
  make_an_error();
  const std::string message = message_of([] { gl::check_errors("here"); });
  EXPECT_NE(message.find("GL_INVALID_ENUM"), std::string::npos) << message;
  EXPECT_NO_THROW(gl::check_errors("here"));
}

TEST_F(GlDebug, AnErrorCarriesTheGroupItHappenedIn) {
  {
    const gl::DebugGroup outer("frame");
    const gl::DebugGroup inner("blur");
    make_an_error();
  }
  EXPECT_EQ(message_of([] { gl::check_errors("elsewhere"); }).find("blur: "), 0u);
}

TEST_F(GlDebug, APassThrowsAtItsNextStepAndTimersStayBalanced) {
  gl::Device device({}, gl::Timers::Mode::finish);
  const gl::Texture& target = device.target("t", {});
  device.timers.begin_frame();
  EXPECT_EQ(message_of([&] {
              make_an_error();
              gl::Pass(device, {.name = "late", .colors = {{.texture = &target}}});
            }).find("late: "),
            std::string::npos)
      << "the error is older than the pass";
  {
    const gl::Pass pass(device, {.name = "shadow map", .colors = {{.texture = &target}}});
    make_an_error();
  }
  EXPECT_EQ(message_of([&] { gl::Pass(device, {.name = "next"}); }).find("shadow map: "), 0u);
  device.timers.end_frame();
  EXPECT_EQ(device.timers.rows().size(), 4u);
}

TEST_F(GlDebug, WithoutTheCallbackErrorsAreStillFound) {
  const auto plain = gl::make_context(test::backend_name());
  make_an_error();
  EXPECT_EQ(message_of([] { gl::check_errors("plain"); }), "plain: GL_INVALID_ENUM");
}

TEST_F(GlDebug, ObjectsAreLabelled) {
  const gl::Texture texture("shadow map", {});
  char text[64] = {};
  gl::glGetObjectLabel(GL_TEXTURE, texture.id(), sizeof(text), nullptr, text);
  EXPECT_STREQ(text, "shadow map");
}

}  // namespace
}  // namespace penumbra

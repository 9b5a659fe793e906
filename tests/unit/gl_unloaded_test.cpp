// What is made before OpenGL's entry points are loaded: no test of this program loads them.
#include <gtest/gtest.h>

#include "core/error.h"
#include "gl/context.h"
#include "gl/device.h"
#include "shadow/soft_shadows.h"

namespace penumbra {
namespace {

std::string message_of(void (*call)()) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

void render() {
  gl::Device device({}, gl::Timers::Mode::off);
  shadow::SoftShadows shadows(device);
  shadows.render({}, ParamSet(shadows.registry().params()));
}

constexpr const char* refusal = "soft shadows: OpenGL's entry points are not loaded; call load_api()";

TEST(GlUnloaded, ARenderIsRefused) { EXPECT_EQ(message_of(render), refusal); }

TEST(GlUnloaded, ALoaderThatFindsNothingIsRefused) {
  EXPECT_EQ(message_of([] { gl::load_api(nullptr); }),
            "OpenGL 4.5: load_api() got no function that finds entry points");
  const std::string message = message_of([] { gl::load_api([](const char*) -> void* { return nullptr; }); });
  EXPECT_TRUE(message.starts_with("OpenGL 4.5: the driver lacks gl")) << message;
  EXPECT_EQ(message_of(render), refusal);
}

}  // namespace
}  // namespace penumbra

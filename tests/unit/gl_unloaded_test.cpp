// What is made before OpenGL's entry points are loaded: no test of this program loads them.
#include <gtest/gtest.h>

#include "core/error.h"
#include "gl/context.h"
#include "gl/device.h"

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

TEST(GlUnloaded, ADeviceIsRefused) {
  EXPECT_EQ(message_of([] { const gl::Device device({}, gl::Timers::Mode::off); }),
            "OpenGL: load_api() must be called before a Device is made");
}

TEST(GlUnloaded, ALoaderThatFindsNothingIsRefused) {
  EXPECT_EQ(message_of([] { gl::load_api(nullptr); }),
            "OpenGL 4.5: load_api() got no function that finds entry points");
  const std::string message = message_of([] { gl::load_api([](const char*) -> void* { return nullptr; }); });
  EXPECT_TRUE(message.starts_with("OpenGL 4.5: the driver lacks gl")) << message;
  EXPECT_EQ(message_of([] { const gl::Device device({}, gl::Timers::Mode::off); }),
            "OpenGL: load_api() must be called before a Device is made");
}

}  // namespace
}  // namespace penumbra

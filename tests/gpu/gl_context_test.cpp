#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>

#include "gl/api.h"
#include "gpu_test.h"

namespace penumbra {
namespace {

using test::message_of;

std::string gl_version() { return reinterpret_cast<const char*>(gl::glGetString(GL_VERSION)); }

// Clears a target of one texel on the current context, and reads it back.
float drawn_red() {
  gl::Device device({}, gl::Timers::Mode::off);
  const gl::Texture& target = device.target("target", {.format = GL_R32F});
  test::clear(device, {.name = "clear", .colors = {{.texture = &target, .clear = glm::vec4(0.25f)}}});
  return gl::read_floats(target, 1).front();
}

void expect_core_4_5_that_draws(const gl::Context& context) {
  GLint profile = 0;
  gl::glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  EXPECT_EQ(profile, GL_CONTEXT_CORE_PROFILE_BIT);
  EXPECT_GE(gl_version(), "4.5");
  EXPECT_NE(context.get_proc_address(), nullptr);
  EXPECT_FLOAT_EQ(drawn_red(), 0.25f);
  EXPECT_NO_THROW(gl::check_errors("context"));
}

// Unsets an environment variable, and restores it in the destructor.
class Unset {
 public:
  explicit Unset(const char* name) : name_(name) {
    if (const char* value = std::getenv(name)) value_ = value;
    unsetenv(name);
  }
  ~Unset() {
    if (value_) setenv(name_, value_->c_str(), 1);
  }
  Unset(const Unset&) = delete;
  Unset& operator=(const Unset&) = delete;

 private:
  const char* name_;
  std::optional<std::string> value_;
};

TEST(GlContext, EglGivesCoreWithoutDisplay) {
  const Unset x11("DISPLAY");
  const auto context = gl::make_egl_context({.debug = true});
  EXPECT_EQ(context->backend(), gl::Backend::egl);
  expect_core_4_5_that_draws(*context);
}

TEST(GlContext, OsMesaGivesCore) {
  const auto context = gl::make_osmesa_context({.debug = true});
  EXPECT_EQ(context->backend(), gl::Backend::osmesa);
  expect_core_4_5_that_draws(*context);
}

TEST(GlContext, EveryListedEglDeviceEitherDrawsOrSaysWhyNot) {
  const std::vector<std::string> names = gl::egl_devices();
  ASSERT_FALSE(names.empty());
  int drawing = 0;
  for (int index = 0; index < static_cast<int>(names.size()); ++index) {
    EXPECT_FALSE(names[static_cast<std::size_t>(index)].empty());
    try {
      expect_core_4_5_that_draws(*gl::make_egl_context({.debug = true, .egl_device = index}));
      ++drawing;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("EGL device " + std::to_string(index)), std::string::npos);
    }
  }
  EXPECT_GE(drawing, 1);
}

TEST(GlContext, AnEglDeviceThatIsNotThereIsNamed) {
  const std::string message = message_of([] { gl::make_egl_context({.egl_device = 99}); });
  EXPECT_NE(message.find("no device 99"), std::string::npos) << message;
  EXPECT_THROW(gl::make_egl_context({.egl_device = -1}), Error);
}

TEST(GlContext, AWindowWithoutADisplayIsAnErrorThatSaysSo) {
  const Unset x11("DISPLAY");
  const Unset wayland("WAYLAND_DISPLAY");
  const std::string message = message_of([] { gl::make_window_context({.visible = false}); });
  EXPECT_EQ(message.find("window: "), 0u) << message;
  EXPECT_NE(message.find("DISPLAY"), std::string::npos) << message;
}

TEST(GlContext, AWindowGivesCoreWhereThereIsADisplay) {
  if (std::getenv("DISPLAY") == nullptr) GTEST_SKIP() << "no display; xvfb-run gives one";
  const auto context = gl::make_window_context({.debug = true, .width = 64, .height = 64, .visible = false});
  EXPECT_EQ(context->backend(), gl::Backend::window);
  expect_core_4_5_that_draws(*context);
}

TEST(GlContext, AutoIsOffscreenAndAnUnknownBackendHasNearNames) {
  EXPECT_EQ(gl::make_context("auto")->backend(), gl::Backend::egl);
  EXPECT_EQ(message_of([] { gl::make_context("osmeza"); }), "unknown backend 'osmeza'; did you mean 'osmesa'?");
}

TEST(GlContext, ContextsFollowEachOther) {
  for (int i = 0; i < 3; ++i) {
    expect_core_4_5_that_draws(*gl::make_egl_context({.debug = true}));
    expect_core_4_5_that_draws(*gl::make_osmesa_context({.debug = true}));
  }
}

TEST(GlContext, ContextsTakeTurnsAndEachKeepsItsState) {
  const auto point_size = [] {
    GLfloat size = 0;
    gl::glGetFloatv(GL_POINT_SIZE, &size);
    return size;
  };
  auto egl = gl::make_egl_context({.debug = true});
  gl::glPointSize(2.0f);
  const auto osmesa = gl::make_osmesa_context({.debug = true});
  gl::glPointSize(3.0f);
  for (int turn = 0; turn < 2; ++turn) {
    egl->make_current();
    EXPECT_EQ(point_size(), 2.0f);
    osmesa->make_current();
    EXPECT_EQ(point_size(), 3.0f);
  }
  egl.reset();
  EXPECT_EQ(point_size(), 3.0f) << "destroying a context that is not current changes nothing";
  expect_core_4_5_that_draws(*osmesa);
}

TEST(GlContext, DebugOutputBelongsToTheContextThatAskedForIt) {
  const auto plain = gl::make_egl_context({.debug = false});
  EXPECT_FALSE(gl::debug_enabled());
  const auto debug = gl::make_egl_context({.debug = true});
  EXPECT_TRUE(gl::debug_enabled());
  plain->make_current();
  EXPECT_FALSE(gl::debug_enabled());
}

TEST(GlContext, MissingEntryPointsAreNamed) {
  const auto context = gl::make_egl_context();
  static const gl::GetProcAddress driver = context->get_proc_address();
  const gl::GetProcAddress without_dsa = [](const char* name) -> void* {
    return std::strncmp(name, "glCreate", 8) == 0 ? nullptr : driver(name);
  };
  const std::string message = message_of([&] { gl::load_api(without_dsa); });
  EXPECT_NE(message.find("glCreateProgram"), std::string::npos) << message;
  EXPECT_NE(message.find("more"), std::string::npos) << message;
  EXPECT_NO_THROW(gl::load_api(driver));
  EXPECT_FLOAT_EQ(drawn_red(), 0.25f);
}

// A driver whose glGetIntegerv answers one query with a given value.
gl::GetProcAddress real_driver = nullptr;
GLenum question = 0;
GLint answer = 0;

void APIENTRY told_get_integer(GLenum name, GLint* value) {
  if (name == question) {
    *value = answer;
  } else {
    reinterpret_cast<PFNGLGETINTEGERVPROC>(real_driver("glGetIntegerv"))(name, value);
  }
}

std::string refusal_when(GLenum name, GLint value) {
  question = name;
  answer = value;
  return message_of([] {
    gl::load_api([](const char* function) -> void* {
      return std::strcmp(function, "glGetIntegerv") == 0 ? reinterpret_cast<void*>(told_get_integer)
                                                         : real_driver(function);
    });
  });
}

TEST(GlContext, AContextOfAnotherVersionIsRefused) {
  const auto context = gl::make_egl_context();
  real_driver = context->get_proc_address();
  EXPECT_EQ(refusal_when(GL_MAJOR_VERSION, 3), "OpenGL 4.5: the context is OpenGL 3.5");
  EXPECT_EQ(refusal_when(GL_MINOR_VERSION, 4), "OpenGL 4.5: the context is OpenGL 4.4");
  EXPECT_EQ(refusal_when(GL_MAJOR_VERSION, 0), "OpenGL 4.5: no context is current");
  EXPECT_NO_THROW(gl::load_api(real_driver));
}

const GLubyte* APIENTRY told_version_of_es(GLenum /*name*/) {
  return reinterpret_cast<const GLubyte*>("OpenGL ES 4.2 of a driver");
}

TEST(GlContext, AContextOfOpenGlEsIsRefusedAsSuch) {
  const auto context = gl::make_egl_context();
  real_driver = context->get_proc_address();
  question = GL_MINOR_VERSION;
  answer = 2;
  EXPECT_EQ(message_of([] {
              gl::load_api([](const char* function) -> void* {
                if (std::strcmp(function, "glGetIntegerv") == 0) return reinterpret_cast<void*>(told_get_integer);
                return std::strcmp(function, "glGetString") == 0 ? reinterpret_cast<void*>(told_version_of_es)
                                                                 : real_driver(function);
              });
            }),
            "OpenGL 4.5: the context is OpenGL ES 4.2");
}

TEST(GlContext, BuildsWithAssertionsHaveADebugContextUnlessToldOtherwise) {
#ifdef NDEBUG
  constexpr bool assertions = false;
#else
  constexpr bool assertions = true;
#endif
  const auto context = gl::make_egl_context();
  EXPECT_EQ(gl::debug_enabled(), assertions);
}

TEST(GlContext, DeviceInfoTellsTheDriverAndItsLimits) {
  const auto context = gl::make_egl_context();
  const gl::DeviceInfo info = gl::device_info();
  EXPECT_FALSE(info.vendor.empty());
  EXPECT_FALSE(info.renderer.empty());
  EXPECT_EQ(info.version, gl_version());
  EXPECT_GE(info.glsl_version, "4.50");
  EXPECT_EQ(info.software, info.renderer.find("llvmpipe") != std::string::npos);
  const auto limit = std::ranges::find(info.limits, "texture size", &gl::DeviceInfo::Limit::name);
  ASSERT_NE(limit, info.limits.end());
  EXPECT_GE(limit->value, 16384);
  EXPECT_TRUE(std::ranges::all_of(info.limits, [](const auto& row) { return row.value > 0; }));
  EXPECT_NO_THROW(gl::check_errors("limits"));
}

}  // namespace
}  // namespace penumbra

// Contexts of the compatibility profile, which most engines have: the same masks as in the core profile, whatever
// legacy state the engine has set, and that state afterwards.
#include <array>
#include <vector>

#include "gl/api.h"
#include "gl/compatibility.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

// An engine with a context of its own; its objects are made and deleted while that is current.
struct Engine {
  explicit Engine(bool compatibility) : context(gl::make_egl_context({.debug = true, .compatibility = compatibility})) {
    renderer = std::make_unique<TriangleRenderer>();
  }

  // By name, since the headers of the core profile lack them.
  template <class... Arguments>
  void call(const char* name, Arguments... arguments) const {
    using Function = void(APIENTRYP)(Arguments...);
    const auto function = reinterpret_cast<Function>(context->get_proc_address()(name));
    ASSERT_NE(function, nullptr) << name;
    function(arguments...);
  }

  std::unique_ptr<gl::Context> context;
  std::unique_ptr<TriangleRenderer> renderer;
};

constexpr GLenum alpha_test = 0x0BC0, polygon_stipple = 0x0B42, line_stipple = 0x0B24, point_smooth = 0x0B10;
constexpr GLenum clamp_fragment_color = 0x891B, map_color = 0x0D10, red_scale = 0x0D14, red_bias = 0x0D15;
constexpr GLenum point_size_max = 0x8127;
constexpr GLenum clip_plane_0 = 0x3000, lighting = 0x0B50, fog = 0x0B60;
constexpr std::array capabilities{alpha_test, polygon_stipple, line_stipple, point_smooth, lighting, fog};

void set_hostile_state(const Engine& engine) {
  for (const GLenum capability : capabilities) gl::glEnable(capability);
  gl::glEnable(clip_plane_0);
  engine.call("glAlphaFunc", GLenum{GL_NEVER}, GLclampf{0});
  const std::array<GLubyte, 128> nothing{};
  engine.call("glPolygonStipple", nothing.data());
  gl::glClampColor(clamp_fragment_color, GL_TRUE);
  engine.call("glPixelTransferf", red_scale, 0.5f);
  engine.call("glPixelTransferf", red_bias, 0.25f);
  engine.call("glPixelTransferi", map_color, GLint{1});
  engine.call("glShadeModel", GLenum{0x1D00});  // GL_FLAT
  gl::glPointParameterf(point_size_max, 2.0f);
}

void expect_hostile_state(const Engine& engine) {
  for (const GLenum capability : capabilities) {
    EXPECT_TRUE(gl::glIsEnabled(capability)) << capability;
    gl::glDisable(capability);
  }
  GLint clamped = 0, mapped = 0;
  GLfloat scale = 0, bias = 0;
  gl::glGetIntegerv(clamp_fragment_color, &clamped);
  gl::glGetIntegerv(map_color, &mapped);
  gl::glGetFloatv(red_scale, &scale);
  gl::glGetFloatv(red_bias, &bias);
  EXPECT_EQ(clamped, GL_TRUE);
  EXPECT_EQ(mapped, 1);
  EXPECT_EQ(scale, 0.5f);
  EXPECT_EQ(bias, 0.25f);
  GLfloat greatest = 0;
  gl::glGetFloatv(point_size_max, &greatest);
  EXPECT_EQ(greatest, 2.0f);
  // Else the test would read its own results by it.
  gl::glClampColor(clamp_fragment_color, GL_FIXED_ONLY);
  engine.call("glPixelTransferf", red_scale, 1.0f);
  engine.call("glPixelTransferf", red_bias, 0.0f);
  engine.call("glPixelTransferi", map_color, GLint{0});
}

enum class LegacyState { none, hostile };

// Two frames of a technique; the second has a history where the technique keeps one.
std::vector<float> masks(const Engine& engine, const std::string& technique, bool history, LegacyState legacy) {
  const TriangleScene scene = box_on_ground(48);
  ParamSet params = engine.renderer->params();
  params.set("technique", technique);
  params.set("cascades.size", 256);
  params.set("history.reuse", history);
  std::vector<float> all;
  for (int frame = 0; frame < 2; ++frame) {
    const Shadowed shadowed = engine.renderer->render(
        scene, params,
        [&](shadow::Inputs& inputs) {
          inputs.mask_details = true;
          inputs.view.last_view = inputs.view.view;
          inputs.view.last_projection = inputs.view.projection;
          if (legacy != LegacyState::hostile) return;
          set_hostile_state(engine);
          inputs.draw = [&, draw = inputs.draw](const shadow::CasterPass& casters, gl::Pass& pass) {
            draw(casters, pass);
            set_hostile_state(engine);
          };
        },
        [&] {
          if (legacy == LegacyState::hostile) expect_hostile_state(engine);
        });
    all.insert(all.end(), shadowed.mask.begin(), shadowed.mask.end());
  }
  EXPECT_NO_THROW(gl::check_errors("frames"));
  return all;
}

TEST(GlCompatibility, EveryTechniqueGivesTheMaskOfTheCoreProfile) {
  const std::vector<std::string> techniques = [] {
    const Engine engine(false);
    std::vector<std::string> names;
    for (const shadow::Technique& technique : engine.renderer->shadows().registry().techniques())
      names.push_back(technique.name);
    return names;
  }();
  ASSERT_GT(techniques.size(), 15u);
  const auto all = [&](LegacyState legacy) {
    // A context at a time: entry points are those of the last one.
    const Engine engine(legacy != LegacyState::none);
    EXPECT_EQ(gl::has_legacy_state(), legacy != LegacyState::none);
    std::vector<std::vector<float>> found;
    for (const std::string& technique : techniques)
      found.push_back(masks(engine, technique, technique == "pcss", legacy));
    return found;
  };
  const auto core = all(LegacyState::none), other = all(LegacyState::hostile);
  for (std::size_t i = 0; i < techniques.size(); ++i) EXPECT_EQ(core[i], other[i]) << techniques[i];
}

TEST(GlCompatibility, ARecordedDisplayListIsOneClearError) {
  const Engine engine(true);
  const TriangleScene scene = box_on_ground(16);
  const std::string message = message_of([&] {
    engine.renderer->render(scene, engine.renderer->params(), [&](shadow::Inputs&) {
      engine.call("glNewList", GLuint{3}, GLenum{0x1300});  // GL_COMPILE
    });
  });
  engine.call("glEndList");
  EXPECT_EQ(message, "soft shadows: OpenGL records calls for the display list 3; end it before");
  EXPECT_NO_THROW(engine.renderer->render(scene, engine.renderer->params()));
}

TEST(GlCompatibility, ATextureOfAnotherTargetIsRefusedAsInTheCoreProfile) {
  std::vector<std::string> messages;
  for (const bool compatibility : {false, true}) {
    const Engine engine(compatibility);
    GLuint array = 0, cube = 0;
    gl::glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &array);
    gl::glTextureStorage3D(array, 1, GL_DEPTH_COMPONENT32F, 16, 16, 1);
    gl::glCreateTextures(GL_TEXTURE_CUBE_MAP, 1, &cube);
    gl::glTextureStorage2D(cube, 1, GL_DEPTH_COMPONENT32F, 16, 16);
    messages.push_back(message_of([&] {
      engine.renderer->render(box_on_ground(16), engine.renderer->params(), [&](shadow::Inputs& inputs) {
        inputs.depth = {cube, 16, 16};
      });
    }));
    EXPECT_EQ(gl::target_of(array), static_cast<GLenum>(GL_TEXTURE_2D_ARRAY));
    gl::glDeleteTextures(1, &array);
    gl::glDeleteTextures(1, &cube);
  }
  EXPECT_NE(messages[0].find("is not a GL_TEXTURE_2D"), std::string::npos) << messages[0];
  EXPECT_EQ(messages[0], messages[1]);
}

TEST(GlCompatibility, WithoutACurrentContextARenderIsOneClearError) {
  Engine engine(false);
  const TriangleScene scene = box_on_ground(16);
  const std::string message = message_of([&] {
    engine.renderer->render(scene, engine.renderer->params(), [&](shadow::Inputs&) { engine.context.reset(); });
  });
  EXPECT_EQ(message, "soft shadows: no OpenGL context is current");
}

TEST(GlCompatibility, ARenderWithinARenderIsOneClearError) {
  const Engine engine(false);
  const TriangleScene scene = box_on_ground(16);
  std::string message;
  const ParamSet params = engine.renderer->params();
  engine.renderer->render(scene, params, [&](shadow::Inputs& inputs) {
    inputs.draw = [&, draw = inputs.draw, inner = inputs](const shadow::CasterPass& casters, gl::Pass& pass) {
      if (message.empty()) message = message_of([&] { engine.renderer->shadows().render(inner, params); });
      draw(casters, pass);
    };
  });
  EXPECT_EQ(message, "soft shadows: render() was called from within render()");
  EXPECT_NO_THROW(engine.renderer->render(scene, params));
}

}  // namespace
}  // namespace penumbra::test

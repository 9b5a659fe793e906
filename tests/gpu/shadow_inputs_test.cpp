// Inputs: bad input is refused with one line that names it, and a view may cover a part of its textures.

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <tuple>

#include "core/log.h"
#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

class ShadowInputs : public GpuTest {
 protected:
  ShadowInputs() { params.set("cascades.size", 512); }

  // The message with which inputs are refused after `change` has changed them.
  std::string refusal(const TriangleRenderer::Adjust& change) {
    return message_of([&] { renderer.render(box_on_ground(48), params, change); });
  }
  void expect_refusal(const std::string& says, const TriangleRenderer::Adjust& change) {
    const std::string message = refusal(change);
    EXPECT_EQ(message.find("soft shadows: "), 0u) << message;
    EXPECT_NE(message.find(says), std::string::npos) << message << "\nshould say: " << says;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  shadow::TextureView texture(const char* name, const gl::TextureDesc& desc) {
    return {renderer.device().target(name, desc).id(), desc.width, desc.height};
  }

  TriangleRenderer renderer;
  ParamSet params = renderer.params();
};

TEST_F(ShadowInputs, MatricesAndBoxesAreChecked) {
  using shadow::Inputs;
  expect_refusal("the view matrix is not finite", [](Inputs& in) { in.view.view[3][1] = infinite; });
  expect_refusal("the view matrix has no inverse", [](Inputs& in) { in.view.view = glm::mat4(0); });
  const char* view_alone = "the view matrix does more than turn, mirror and move";
  expect_refusal(view_alone, [](Inputs& in) { in.view.view = glm::transpose(in.view.view); });
  expect_refusal(view_alone, [](Inputs& in) { in.view.view = glm::scale(in.view.view, glm::vec3(2)); });
  expect_refusal("a camera that looks along +z",
                 [](Inputs& in) { in.view.projection = glm::perspectiveLH_ZO(0.8f, 1.0f, 100.0f, 0.1f); });
  const char* turned = "the projection matrix turns or skews the picture";
  expect_refusal(turned, [](Inputs& in) {
    const glm::mat4 roll(0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    in.view.projection = roll * in.view.projection;
  });
  expect_refusal(turned, [](Inputs& in) { in.view.projection[1][0] = 0.2f; });
  expect_refusal("the projection matrix is not finite", [](Inputs& in) { in.view.projection[0][0] = NAN; });
  expect_refusal("the projection matrix has no inverse", [](Inputs& in) { in.view.projection[0][0] = 0; });
  expect_refusal("the jitter is not finite", [](Inputs& in) { in.view.jitter.x = NAN; });
  expect_refusal("the jitter moves the picture", [](Inputs& in) { in.view.jitter.y = -1.5f; });
  expect_refusal("the bounding box of the casters is empty", [](Inputs& in) { in.casters = Inputs().casters; });
  expect_refusal("the bounding box of the receivers is empty", [](Inputs& in) { in.receivers.min.y = 100; });
  expect_refusal("the bounding box of the casters is not finite", [](Inputs& in) { in.casters.max.x = infinite; });
  expect_refusal("the bounding box of the receivers is not finite", [](Inputs& in) { in.receivers.min.z = NAN; });
  expect_refusal("the bounding box of the moved casters is not finite", [](Inputs& in) {
    in.moved = shadow::Box{glm::vec3(0), {0, NAN, 0}};
  });
  expect_refusal("the bounding box of the moved casters is empty", [](Inputs& in) {
    in.moved = shadow::Box{{1, 0, 0}, {0, 1, 1}};
  });
  expect_refusal("the bounding box of the forward receivers is not finite", [](Inputs& in) {
    in.forward_receivers = {glm::vec3(0), {0, NAN, 0}};
  });
  expect_refusal("the bounding box of the forward receivers is empty", [](Inputs& in) {
    in.forward_receivers = {{0, 2, 0}, {1, 1, 1}};
  });
  expect_refusal("casters, receivers and camera may be too far from each other", [](Inputs& in) {
    in.casters.max = glm::vec3(3e38f);
    in.exact_bounds = true;
  });
  EXPECT_NO_THROW(renderer.render(box_on_ground(48), params, [](Inputs& in) {
    in.moved = shadow::Box{glm::vec3(infinite), glm::vec3(-infinite)};
  })) << "none moved";
}

TEST_F(ShadowInputs, BoxesMayBePoints) {
  for (const char* fit : {"stable", "visible", "penumbrae"}) {
    params.set("cascades.fit", std::string(fit));
    EXPECT_NO_THROW(renderer.render(box_on_ground(48), params, [](shadow::Inputs& in) {
      in.receivers = {glm::vec3(0.5f), glm::vec3(0.5f)};
    })) << fit;
    EXPECT_NO_THROW(renderer.render(box_on_ground(48), params, [](shadow::Inputs& in) {
      in.casters = in.receivers = {glm::vec3(0.5f), glm::vec3(0.5f)};
    })) << fit;
  }
}

glm::mat4 finite_perspective(bool reversed, bool zero_to_one, float near, float far) {
  const float first = reversed ? far : near, last = reversed ? near : far;
  return zero_to_one ? glm::perspectiveRH_ZO(0.8f, 1.0f, first, last) : glm::perspectiveRH_NO(0.8f, 1.0f, first, last);
}

glm::mat4 finite_orthographic(bool reversed, bool zero_to_one, float near, float far) {
  const float first = reversed ? far : near, last = reversed ? near : far;
  return zero_to_one ? glm::orthoRH_ZO(-5.0f, 5.0f, -5.0f, 5.0f, first, last)
                     : glm::orthoRH_NO(-5.0f, 5.0f, -5.0f, 5.0f, first, last);
}

// A perspective whose near plane is `plane`, in view space, and which has its greatest distance at a corner of the far
// plane (Lengyel, Oblique View Frustum Depth Projection and Clipping, 2005).
glm::mat4 oblique_perspective(bool reversed, bool zero_to_one, const glm::vec4& plane) {
  glm::mat4 projection = finite_perspective(false, zero_to_one, 0.1f, 100);
  const glm::vec4 corner = glm::inverse(projection) * glm::vec4(glm::sign(plane.x), glm::sign(plane.y), 1, 1);
  const float w = -corner.z;
  const glm::vec4 of_plane = plane * (w / glm::dot(plane, corner));
  const glm::vec4 last(0, 0, -1, 0);
  glm::vec4 third = zero_to_one ? of_plane : 2.0f * of_plane - last;
  if (reversed) third = zero_to_one ? last - third : -third;
  for (int column = 0; column < 4; ++column) projection[column][2] = third[column];
  return projection;
}

const glm::vec4 slanted_plane(0.3f, -0.4f, -1, -0.5f);

// Whatever the planes are, only a projection that contradicts the conventions is refused.
TEST_F(ShadowInputs, ProjectionsThatContradictTheConventionsAreRefused) {
  const auto refused = [&](const glm::mat4& projection, bool reversed, bool zero_to_one) -> std::string {
    try {
      renderer.render(box_on_ground(48), params, [&](shadow::Inputs& in) {
        in.view.projection = in.view.last_projection = projection;
        in.conventions.reversed_z = reversed;
        in.conventions.depth_zero_to_one = zero_to_one;
      });
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const auto expect_direction = [&](const glm::mat4& projection, bool reversed, bool zero_to_one) {
    EXPECT_EQ(refused(projection, reversed, zero_to_one), "");
    EXPECT_EQ(
        refused(projection, !reversed, zero_to_one),
        reversed
            ? "soft shadows: the projection's depth falls with the distance, but the conventions say reversed_z=false"
            : "soft shadows: the projection's depth grows with the distance, but the conventions say reversed_z=true");
  };
  for (const bool reversed : {false, true}) {
    for (const bool zero_to_one : {false, true}) {
      for (const glm::vec2 planes :
           {glm::vec2(0.1f, 100), glm::vec2(5, 10), glm::vec2(8, 10), glm::vec2(1e-3f, 1e5f)}) {
        SCOPED_TRACE(testing::Message() << planes.x << " to " << planes.y);
        expect_direction(finite_perspective(reversed, zero_to_one, planes.x, planes.y), reversed, zero_to_one);
        expect_direction(finite_orthographic(reversed, zero_to_one, planes.x, planes.y), reversed, zero_to_one);
        expect_direction(finite_orthographic(reversed, zero_to_one, -planes.y, planes.y), reversed, zero_to_one);
      }
      SCOPED_TRACE("an oblique near plane");
      expect_direction(oblique_perspective(reversed, zero_to_one, slanted_plane), reversed, zero_to_one);
    }
  }
  const glm::mat4 infinite_far = perspective(0.8f, 1, 0.1f);
  EXPECT_EQ(refused(infinite_far, true, true), "");
  EXPECT_EQ(
      refused(infinite_far, true, false),
      "soft shadows: the projection's depth is above 0 everywhere, but the conventions say depth_zero_to_one=false");
  EXPECT_NE(refused(finite_perspective(true, true, 0.1f, 100), true, false).find("above -0.001 everywhere"),
            std::string::npos);
  EXPECT_NE(refused(oblique_perspective(true, true, slanted_plane), true, false).find("everywhere"), std::string::npos);
}

// What a view's first frame warns of with this projection and these conventions, called with clip space set like that.
class ClipControl : public ShadowInputs {
 protected:
  int warnings(const glm::mat4& projection, const shadow::Conventions& conventions, GLenum clip_depth, int view = 0,
               int frames = 1) {
    int count = 0;
    set_log_sink([&](LogLevel level, std::string_view line) {
      if (level == LogLevel::warning && line.find("glClipControl") != std::string_view::npos) ++count;
    });
    for (int frame = 0; frame < frames; ++frame) {
      renderer.render(box_on_ground(48), params, [&](shadow::Inputs& in) {
        in.view.id = view;
        in.view.projection = projection;
        in.conventions = conventions;
        gl::glClipControl(GL_LOWER_LEFT, clip_depth);
      });
    }
    set_log_sink({});
    return count;
  }
  int first_warnings(const glm::mat4& projection, const shadow::Conventions& conventions, GLenum clip_depth) {
    renderer.shadows().forget_view(0);
    return warnings(projection, conventions, clip_depth);
  }
};

TEST_F(ClipControl, AContradictionIsAWarning) {
  constexpr shadow::Conventions from_zero{.reversed_z = false, .depth_zero_to_one = true};
  constexpr shadow::Conventions from_minus_one{.reversed_z = false, .depth_zero_to_one = false};
  for (const bool drawn_from_zero : {false, true}) {
    for (const auto& projection :
         {finite_perspective(false, drawn_from_zero, 0.1f, 100), finite_orthographic(false, drawn_from_zero, 0.1f, 100),
          oblique_perspective(false, drawn_from_zero, slanted_plane)}) {
      EXPECT_EQ(first_warnings(projection, from_zero, GL_ZERO_TO_ONE), 0);
      EXPECT_EQ(first_warnings(projection, from_minus_one, GL_NEGATIVE_ONE_TO_ONE), 0);
      EXPECT_EQ(first_warnings(projection, from_zero, GL_NEGATIVE_ONE_TO_ONE), 1);
      EXPECT_EQ(first_warnings(projection, from_minus_one, GL_ZERO_TO_ONE), 1);
    }
  }
}

// Reversed Z is drawn with z in 0..1, except by mistake; engines set glClipControl for it and may set it back.
TEST_F(ClipControl, ReversedDepthsThatCanOnlyBeFromZeroAreNoContradiction) {
  EXPECT_EQ(first_warnings(perspective(0.8f, 1, 0.1f), {}, GL_NEGATIVE_ONE_TO_ONE), 0);
  EXPECT_EQ(first_warnings(finite_perspective(true, true, 0.1f, 100), {}, GL_NEGATIVE_ONE_TO_ONE), 0);
  EXPECT_EQ(first_warnings(oblique_perspective(true, true, slanted_plane), {}, GL_NEGATIVE_ONE_TO_ONE), 0);
  EXPECT_EQ(first_warnings(orthographic(5, 5, 0.1f, 100), {}, GL_NEGATIVE_ONE_TO_ONE), 0);
  EXPECT_EQ(first_warnings(finite_perspective(true, false, 0.1f, 100), {}, GL_NEGATIVE_ONE_TO_ONE), 1);
}

TEST_F(ClipControl, IsLookedAtInTheFirstFrameOfAView) {
  constexpr shadow::Conventions from_zero{.reversed_z = false},
      from_minus_one{.reversed_z = false, .depth_zero_to_one = false};
  const glm::mat4 projection = finite_perspective(false, true, 0.1f, 100);
  EXPECT_EQ(warnings(projection, from_zero, GL_NEGATIVE_ONE_TO_ONE, 0, 3), 1);
  EXPECT_EQ(warnings(projection, from_zero, GL_NEGATIVE_ONE_TO_ONE, 1), 0) << "the library may have set it";
  EXPECT_EQ(warnings(projection, from_minus_one, GL_ZERO_TO_ONE, 2, 3), 1);
}

// Before a pass begins, and after one has: what the first frame found is told, not what that one left.
TEST_F(ClipControl, IsToldWhereTheFirstFrameFailed) {
  const glm::mat4 projection = finite_perspective(false, true, 0.1f, 100);
  const auto fail_with = [&](int view, bool zero_to_one, GLenum clip_depth, bool in_pass) {
    return refusal([=](shadow::Inputs& in) {
      in.view.id = view;
      in.view.projection = projection;
      in.conventions = {.reversed_z = false, .depth_zero_to_one = zero_to_one};
      if (!in_pass) in.view.jitter.x = NAN;
      in.draw = [](const shadow::CasterPass&, gl::Pass&) { throw Error("no casters"); };
      gl::glClipControl(GL_LOWER_LEFT, clip_depth);
    });
  };
  constexpr shadow::Conventions from_zero{.reversed_z = false},
      from_minus_one{.reversed_z = false, .depth_zero_to_one = false};
  for (const bool in_pass : {false, true}) {
    renderer.shadows().forget_view(0);
    EXPECT_NE(fail_with(0, true, GL_NEGATIVE_ONE_TO_ONE, in_pass), "");
    EXPECT_EQ(warnings(projection, from_zero, GL_NEGATIVE_ONE_TO_ONE, 0, 2), 1) << in_pass;
    renderer.shadows().forget_view(0);
    EXPECT_NE(fail_with(0, false, GL_NEGATIVE_ONE_TO_ONE, in_pass), "");
    EXPECT_EQ(warnings(projection, from_minus_one, GL_ZERO_TO_ONE, 0, 2), 0) << "set by the failed frame";
  }
}

// The camera moves through the scene, and its planes move back by as much: the picture stays as it is.
TEST_F(ShadowInputs, AnOrthographicViewMayShowWhatLiesBehindItsCamera) {
  params.set("sun.angle", 2.0f);
  TriangleScene scene = box_on_ground(96);
  scene.receivers = shadow::Box{glm::vec3(-200), glm::vec3(200)};
  const glm::mat4 view = scene.view;
  for (const char* fit : {"stable", "visible", "penumbrae"}) {
    params.set("cascades.fit", fit);
    params.set("cascades.distance", 0.0f);
    const auto from = [&](float forward) {
      scene.view = glm::translate(glm::mat4(1), glm::vec3(0, 0, forward)) * view;
      scene.projection = orthographic(5, 5, 1 - forward, 31 - forward);
      return renderer.render(scene, params).visibilities();
    };
    const std::vector<float> before = from(0);
    EXPECT_GT(std::ranges::count_if(before, [](float seen) { return seen < 0.1f; }), 100);
    for (const float forward : {8.0f, 30.0f}) {
      params.set("cascades.distance", forward > 20 ? 40.0f : 0.0f);
      const std::vector<float> behind = from(forward);
      int wrong = 0;
      for (std::size_t i = 0; i < before.size(); ++i) wrong += std::abs(before[i] - behind[i]) > 0.25f ? 1 : 0;
      EXPECT_LE(wrong, 20) << fit << ", " << forward << " m";
    }
  }
}

TEST_F(ShadowInputs, AProjectionMayBeScaledAsAWhole) {
  params.set("cascades.distance", 20.0f);
  const std::vector<float> plain = renderer.render(box_on_ground(), params).visibilities();
  EXPECT_GT(std::ranges::count(plain, 0.0f), 50);
  EXPECT_EQ(
      renderer.render(box_on_ground(), params, [](shadow::Inputs& in) { in.view.projection *= 4; }).visibilities(),
      plain);
}

// Shadow volumes compute with the direction itself, other techniques with the axes made from it.
TEST_F(ShadowInputs, TheLengthOfASunsDirectionDoesNotMatter) {
  for (const char* technique : {"shadow_volume", "hard"}) {
    params.set("technique", technique);
    const TriangleScene scene = box_on_ground();
    const std::vector<float> plain = renderer.render(scene, params).visibilities();
    const shadow::Light longer{.source = shadow::Sun{20.0f * scene.to_light}};
    const auto given = [&](shadow::Inputs& in) { in.lights = {&longer, 1}; };
    const std::vector<float> same = renderer.render(scene, params, given).visibilities();
    int wrong = 0;
    for (std::size_t i = 0; i < plain.size(); ++i) wrong += std::abs(plain[i] - same[i]) > 0.1f ? 1 : 0;
    EXPECT_LE(wrong, 2) << technique;
  }
}

TEST_F(ShadowInputs, ObliqueNearPlanesChangeNoShadow) {
  // The second one nearly lies in the ground: depths of the picture's middle lie behind the camera elsewhere.
  for (const glm::vec4& plane : {slanted_plane, glm::vec4(-0.007f, -0.96f, -0.27f, -0.15f)}) {
    for (int i = 0; i < 12; ++i) {
      const bool reversed = (i & 1) != 0, zero_to_one = (i & 2) != 0;
      params.set("cascades.fit", i < 4 ? "stable" : i < 8 ? "visible" : "penumbrae");
      const Shadowed plain = renderer.render(box_on_ground(), params);
      TriangleScene scene = box_on_ground();
      scene.conventions.reversed_z = reversed;
      scene.conventions.depth_zero_to_one = zero_to_one;
      scene.projection = oblique_perspective(reversed, zero_to_one, plane);
      const Shadowed oblique = renderer.render(scene, params);
      int wrong = 0, shadowed = 0;
      for (int y = 0; y < plain.height; ++y) {
        for (int x = 0; x < plain.width; ++x) {
          if (oblique.sky(x, y)) continue;  // also what the plane cuts off
          wrong += std::abs(oblique.visibility(x, y) - plain.visibility(x, y)) > 0.1f ? 1 : 0;
          shadowed += plain.visibility(x, y) < 0.1f ? 1 : 0;
        }
      }
      EXPECT_GT(shadowed, 50);
      // Maps that are fitted to the view are divided by depths, which the plane changes.
      EXPECT_LE(wrong, (i & 4) != 0 ? 8 : 4) << plane.x << ", " << (reversed ? "reversed, " : "")
                                             << (zero_to_one ? "0..1, " : "-1..1, ") << params.get_word("cascades.fit");
    }
  }
}

// As for a planar reflection: the view's handedness changes, the shadows do not. Normals are made from depth, as those
// of the test's renderer follow the winding of triangles on the screen.
TEST_F(ShadowInputs, AMirroredViewShowsTheSameShadows) {
  params.set("technique", "brute_force");
  params.set("sun.angle", 4.0f);
  TriangleScene scene = box_on_ground(48);
  const auto without_normals = [](shadow::Inputs& in) { in.normals = {}; };
  const Shadowed plain = renderer.render(scene, params, without_normals);
  scene.view = glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1)) * scene.view;
  const Shadowed mirrored = renderer.render(scene, params, without_normals);
  int wrong = 0, shadowed = 0;
  for (int y = 0; y < plain.height; ++y) {
    for (int x = 0; x < plain.width; ++x) {
      wrong += std::abs(mirrored.visibility(plain.width - 1 - x, y) - plain.visibility(x, y)) > 0.1f ? 1 : 0;
      shadowed += plain.visibility(x, y) < 0.1f ? 1 : 0;
    }
  }
  EXPECT_GT(shadowed, 30);
  EXPECT_LE(wrong, 4);
}

TEST_F(ShadowInputs, TexturesAreChecked) {
  using shadow::Inputs;
  const int size = 48;
  const auto color = texture("color", {.format = GL_RGBA8, .width = size, .height = size});
  const auto float_color = texture("float color", {.format = GL_RGBA16F, .width = size, .height = size});
  const auto packed = texture("packed", {.format = GL_RG16, .width = size, .height = size});
  const auto unsigned_floats = texture("unsigned floats", {.format = GL_R11F_G11F_B10F, .width = size, .height = size});
  const auto half = texture("half", {.format = GL_R16F, .width = size, .height = size});
  const auto one = texture("one", {.format = GL_R32F, .width = size, .height = size});
  const auto small = texture("small", {.format = GL_RG32F, .width = size - 1, .height = size});
  const auto array =
      texture("array", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_R32F, .width = size, .height = size});
  expect_refusal("no depth texture", [](Inputs& in) { in.depth = {}; });
  expect_refusal("depth: 4242 is not the name of a texture", [](Inputs& in) { in.depth.id = 4242; });
  expect_refusal("depth: texture", [](Inputs& in) { in.depth.width += 1; });
  expect_refusal("holds no depth", [&](Inputs& in) { in.depth = color; });
  expect_refusal("holds no depth", [&](Inputs& in) { in.depth = float_color; });
  expect_refusal("has no layer 1", [&](Inputs& in) { in.depth = array, in.depth.layer = 1; });
  expect_refusal("depths of half floats are too coarse to make normals from", [&](Inputs& in) {
    in.depth = half;
    in.normals = {};
  });
  expect_refusal("normals are 47×48, depth is 48×48", [&](Inputs& in) { in.normals = small; });
  expect_refusal("has not 2 channels of a float or SNORM format", [&](Inputs& in) { in.normals = packed; });
  expect_refusal("has not 2 channels of a float or SNORM format, or of a UNORM one", [&](Inputs& in) {
    in.normals = one;
    in.conventions.normals_scale = 2;
  });
  expect_refusal("has floats without a sign", [&](Inputs& in) {
    in.normals = unsigned_floats;
    in.conventions = {.octahedral_normals = false, .normals_scale = 2, .normals_offset = -1};
  });
  expect_refusal("the normals' scale is 0", [&](Inputs& in) { in.conventions.normals_scale = 0; });
  expect_refusal("the normals' scale is 1 and their offset nan",
                 [&](Inputs& in) { in.conventions.normals_offset = NAN; });
  expect_refusal("has not 2 channels", [&](Inputs& in) { in.normals = one; });
  expect_refusal("has not 3 channels", [&](Inputs& in) { in.conventions.octahedral_normals = false; });
  expect_refusal("motion vectors are 47×48", [&](Inputs& in) { in.motion = small; });
  expect_refusal("motion: texture", [&](Inputs& in) { in.motion = {small.id, size, size}; });
  expect_refusal("the viewport of 40×40 at 9, 0 is not a part of 48×48", [](Inputs& in) {
    in.viewport = {9, 0, 40, 40};
  });
  expect_refusal("the viewport of 0×40", [](Inputs& in) { in.viewport = {9, 0, 0, 40}; });
}

TEST_F(ShadowInputs, ParametersThatChangeWhatShadersReadAreRefused) {
  using shadow::Inputs;
  const int size = 48;
  const auto depth =
      texture("two levels", {.format = GL_DEPTH_COMPONENT32F, .width = size, .height = size, .levels = 2});
  const auto maps =
      texture("maps", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_DEPTH_COMPONENT32F, .width = size, .height = size});
  for (const auto& [name, parameter, value] :
       {std::tuple{"GL_TEXTURE_SWIZZLE_R", GL_TEXTURE_SWIZZLE_R, GL_ONE},
        {"GL_TEXTURE_BASE_LEVEL", GL_TEXTURE_BASE_LEVEL, 1},
        {"GL_DEPTH_STENCIL_TEXTURE_MODE", GL_DEPTH_STENCIL_TEXTURE_MODE, GL_STENCIL_INDEX}}) {
    gl::glTextureParameteri(depth.id, static_cast<GLenum>(parameter), value);
    GLint initial = 0;
    gl::glGetTextureParameteriv(maps.id, static_cast<GLenum>(parameter), &initial);
    expect_refusal(fmt::format("depth: {} of texture {} is not OpenGL's initial value", name, depth.id),
                   [&](Inputs& in) { in.depth = depth; });
    gl::glTextureParameteri(depth.id, static_cast<GLenum>(parameter), initial);
  }
  gl::glTextureParameteri(maps.id, GL_TEXTURE_SWIZZLE_R, GL_ZERO);
  shadow::Light light;
  light.maps = shadow::FinishedMaps{maps, shadow::Cascades{.size = size, .items = std::vector<shadow::Cascade>(1)}};
  expect_refusal("maps of light 0: GL_TEXTURE_SWIZZLE_R", [&](Inputs& in) { in.lights = {&light, 1}; });
  const auto swizzle_green = [](const shadow::TextureView& view, GLint value) {
    gl::glTextureParameteri(view.id, GL_TEXTURE_SWIZZLE_G, value);
  };
  renderer.shadows().forget_view(0);  // which knows these textures
  expect_refusal("normals: GL_TEXTURE_SWIZZLE_G", [&](Inputs& in) { swizzle_green(in.normals, GL_ONE); });
  renderer.shadows().forget_view(0);
  EXPECT_NO_THROW(renderer.render(box_on_ground(size), params, [&](Inputs& in) {
    swizzle_green(in.normals, GL_GREEN);
    swizzle_green(in.depth, GL_RED);
  })) << "depth is one channel";
}

TEST_F(ShadowInputs, LightsAreChecked) {
  using shadow::Inputs;
  std::vector<shadow::Light> lights(2);
  const auto with = [&](const auto& change) {
    return [&lights, change](Inputs& in) {
      lights.assign(2, {});
      lights[1].id = 1;
      change(lights);
      in.lights = lights;
    };
  };
  expect_refusal("two lights have the id 1", with([](auto& all) { all[0].id = 1; }));
  expect_refusal("light 0 has no direction", with([](auto& all) {
                   all[0].source = shadow::Sun{.to_light = {0, 0, 0}};
                 }));
  expect_refusal("light 1 has no direction", with([](auto& all) {
                   all[1].source = shadow::Sun{.to_light = {NAN, 0, 1}};
                 }));
  expect_refusal("light 0 has no maps", [](Inputs& in) { in.draw = nullptr; });

  const int size = 64;
  const auto maps =
      texture("maps", {.target = GL_TEXTURE_2D_ARRAY, .format = GL_DEPTH_COMPONENT32F, .width = size, .height = size});
  const auto with_maps = [&](const auto& change) {
    return with([&, change](auto& all) {
      shadow::Cascades cascades{.size = size, .items = std::vector<shadow::Cascade>(1)};
      change(cascades);
      all[0].maps = shadow::FinishedMaps{maps, cascades};
    });
  };
  expect_refusal("light 0: 0 cascades, 1 to 8 fit", with_maps([](auto& c) { c.items.clear(); }));
  expect_refusal("has 1 maps for 2 layers", with_maps([](auto& c) { c.items.resize(2); }));
  expect_refusal("maps of 64×64 and a projection for 32", with_maps([](auto& c) { c.size = 32; }));
  expect_refusal("cascade 0 has no extent", with_maps([](auto& c) { c.items[0].half_extent.y = 0; }));
  expect_refusal("cascade 0 has no extent", with_maps([](auto& c) { c.items[0].far_z = -1; }));
  expect_refusal("cascade 0 is not finite", with_maps([](auto& c) { c.items[0].near_z = NAN; }));
  expect_refusal("light space is not finite", with_maps([](auto& c) { c.anchor.x = NAN; }));
}

TEST_F(ShadowInputs, VisibilityIsTheSameWithAndWithoutDetails) {
  const TriangleScene scene = box_on_ground(48);
  for (const char* technique :
       {"hard", "pcss", "slices", "backprojection", "vssm", "pcss_compute", "thesis_8x8", "thesis_8x8_compute"}) {
    SCOPED_TRACE(technique);
    renderer.shadows().registry().select(params, technique);
    const std::vector<float> detailed = renderer.render(scene, params).visibilities();
    EXPECT_EQ(renderer.mask().texture->desc().format, static_cast<GLenum>(GL_RGBA16F));
    const std::vector<float> plain =
        renderer.render(scene, params, [](shadow::Inputs& in) { in.mask_details = false; }).visibilities();
    EXPECT_EQ(renderer.mask().texture->desc().format, static_cast<GLenum>(GL_R16F));
    EXPECT_EQ(plain, detailed);
  }
}

TEST_F(ShadowInputs, AViewMayBeAPartOfItsTextures) {
  TriangleScene scene = box_on_ground(0);
  scene.width = 60;  // neither side a multiple of a tile's
  scene.height = 45;
  const shadow::Rect part{13, 5, scene.width, scene.height};
  constexpr int width = 80;
  constexpr int height = 64;
  for (const auto& [technique, scale] : {std::pair{"hard", 1},
                                         {"pcss", 1},
                                         {"slices", 1},
                                         {"backprojection", 1},
                                         {"ssss", 1},
                                         {"vssm", 1},
                                         {"pcss_compute", 1},
                                         {"thesis_8x8", 1},
                                         {"thesis_8x8_compute", 1},
                                         {"pcss", 2},
                                         {"slices_denoised", 3}}) {
    renderer.shadows().registry().select(params, technique);
    params.set("mask.scale", scale);
    params.set("sampling.noise", std::string("none"));  // its tile is fixed to the textures
    const Shadowed whole = renderer.render(scene, params);
    const auto larger = [&](const shadow::TextureView& from, GLenum format) {
      const auto to = texture(format == GL_RG32F ? "large normals" : "large depth",
                              {.format = format, .width = width, .height = height});
      gl::glCopyImageSubData(from.id, GL_TEXTURE_2D, 0, 0, 0, 0, to.id, GL_TEXTURE_2D, 0, part.x, part.y, 0, part.width,
                             part.height, 1);
      return to;
    };
    renderer.render(scene, params, [&](shadow::Inputs& in) {
      in.depth = larger(in.depth, GL_DEPTH_COMPONENT32F);
      in.normals = larger(in.normals, GL_RG32F);
      in.viewport = part;
    });
    const gl::Texture& mask = *renderer.mask().texture;
    ASSERT_EQ(glm::ivec2(mask.width(), mask.height()), glm::ivec2(width, height));
    const std::vector<float> texels = gl::read_floats(mask, 4);
    std::vector<float> inside;
    for (int y = 0; y < part.height; ++y) {
      const auto row = texels.begin() + 4 * ((y + part.y) * width + part.x);
      inside.insert(inside.end(), row, row + 4 * part.width);
    }
    EXPECT_EQ(inside, whole.mask) << technique;
    int shadowed = 0;
    for (const float visibility : whole.visibilities()) shadowed += visibility < 0.5f ? 1 : 0;
    EXPECT_GT(shadowed, 10);
  }
}

}  // namespace
}  // namespace penumbra::test

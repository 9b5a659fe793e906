// Maps that are fitted to what the view's depth texture shows (cascades.fit).

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

class ShadowVisible : public TriangleTest {
 protected:
  static constexpr float sun_angle = 0.53f;  // degrees

  ParamSet params(const char* fit = "visible") const {
    ParamSet params = renderer_->params();
    params.set("technique", std::string("pcss"));
    params.set("cascades.fit", std::string(fit));
    params.set("cascades.size", 256);
    params.set("sun.angle", sun_angle);
    return params;
  }
  // The cascades of the last frame.
  const shadow::Cascades& cascades() const { return renderer_->mask().lights.at(0).projection.cascades(); }

  // Bounds in light space of what the picture shows.
  shadow::LightBounds shown(const Shadowed& picture) const {
    shadow::LightBounds bounds;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        if (picture.sky(x, y)) continue;
        const glm::dvec3 place = cascades().world_to_light * (glm::dvec3(picture.point(x, y)) - cascades().anchor);
        bounds = {glm::min(bounds.low, place), glm::max(bounds.high, place)};
      }
    }
    return bounds;
  }

  // Whether the last cascade holds the bounds, and how much longer it is, without what the light's discs need.
  double excess_width(const shadow::LightBounds& bounds) const {
    const shadow::Cascade& last = cascades().items.back();
    const glm::dvec2 center(last.center);
    const glm::dvec2 half(last.half_extent);
    EXPECT_GE(bounds.low.x, center.x - half.x);
    EXPECT_GE(bounds.low.y, center.y - half.y);
    EXPECT_LE(bounds.high.x, center.x + half.x);
    EXPECT_LE(bounds.high.y, center.y + half.y);
    const glm::dvec2 size = glm::dvec2(bounds.high) - glm::dvec2(bounds.low);
    // At the depth of the deepest receiver.
    const double disc = std::tan(glm::radians(0.5 * static_cast<double>(sun_angle))) *
                        (bounds.high.z - static_cast<double>(last.near_z));
    return 2.0 * (std::max(half.x, half.y) - disc) / std::max(size.x, size.y);
  }
};

// A ground of 10 m in a world of kilometres.
TriangleScene small_in_large() {
  TriangleScene scene = box_on_ground(64);
  scene.receivers = shadow::Box{{-2000, -10, -2000}, {2000, 50, 2000}};
  scene.projection = perspective(glm::radians(50.0f), 1, 0.1f);
  return scene;
}

TEST_F(ShadowVisible, CascadesAreAsWideAsWhatTheViewShows) {
  const TriangleScene scene = small_in_large();
  const Shadowed picture = renderer_->render(scene, params());
  EXPECT_LE(excess_width(shown(picture)), 1.15);
  const glm::vec2 visible = cascades().texel(0);
  renderer_->render(scene, params("stable"));
  EXPECT_GT(cascades().texel(3).x, 100 * visible.x);
}

// The same picture with its depths stored in other ways.
TEST_F(ShadowVisible, ConventionsAndViewportsChangeNothing) {
  const TriangleScene scene = small_in_large();
  const Shadowed expected = renderer_->render(scene, params());
  const shadow::Cascades as_stored = cascades();
  const auto expect_same = [&](const char* what) {
    ASSERT_EQ(cascades().items.size(), as_stored.items.size());
    ASSERT_EQ(cascades().size, as_stored.size);
    const float widest = as_stored.texel(static_cast<int>(as_stored.items.size()) - 1).x;
    for (std::size_t i = 0; i < as_stored.items.size(); ++i) {
      EXPECT_FLOAT_EQ(cascades().items[i].half_extent.x, as_stored.items[i].half_extent.x) << what << ", cascade " << i;
      EXPECT_FLOAT_EQ(cascades().items[i].half_extent.y, as_stored.items[i].half_extent.y) << what << ", cascade " << i;
      EXPECT_LE(glm::length(cascades().items[i].center - as_stored.items[i].center), 2 * widest) << what;
    }
  };
  const int size = expected.width;
  gl::Texture depth("depth", {.format = GL_R32F, .width = size, .height = size});
  const auto store = [&](std::vector<float> depths) {
    depth.upload(GL_RED, GL_FLOAT, std::as_bytes(std::span(depths)));
  };

  std::vector<float> depths = expected.depth;
  for (float& stored : depths) stored = 1 - stored;
  store(depths);
  renderer_->render(scene, params(), [&](shadow::Inputs& in) {
    in.depth.id = depth.id();
    in.conventions.reversed_z = false;
    const glm::mat4 flip(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 0, 0, 1, 1);
    in.view.projection = in.view.last_projection = flip * in.view.projection;
  });
  expect_same("depth grows away from the camera");

  renderer_->render(scene, params(), [&](shadow::Inputs& in) {
    in.conventions.depth_zero_to_one = false;
    const glm::mat4 widen(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 2, 0, 0, 0, -1, 1);
    in.view.projection = in.view.last_projection = widen * in.view.projection;
  });
  expect_same("clip-space z from -1 to 1");

  depths = expected.depth;
  for (std::size_t i = 0; i < depths.size(); i += 37) {
    if (depths[i] == 0) depths[i] = i % 2 == 0 ? std::nanf("") : std::numeric_limits<float>::infinity();
  }
  store(depths);
  renderer_->render(scene, params(), [&](shadow::Inputs& in) { in.depth.id = depth.id(); });
  expect_same("depths that are no numbers");
}

TEST_F(ShadowVisible, AViewOfTheSkyIsDrawn) {
  TriangleScene scene = small_in_large();
  scene.view = glm::mat4(1);
  scene.view[3] = glm::vec4(0, -500, 0, 1);  // above all surfaces, looking ahead
  const Shadowed picture = renderer_->render(scene, params());
  for (const float visibility : picture.visibilities()) ASSERT_EQ(visibility, 1);
}

TEST_F(ShadowVisible, ForwardReceiversAreWithinTheLastCascade) {
  const TriangleScene scene = small_in_large();
  renderer_->render(scene, params());
  const auto area = [&] { return cascades().items.back().half_extent.x * cascades().items.back().half_extent.y; };
  const float alone = area();
  const shadow::Box beyond{{-6, -12, -15}, {0, -10, -9}};  // in the view, behind the ground
  renderer_->render(scene, params(), [&](shadow::Inputs& in) { in.forward_receivers = beyond; });
  EXPECT_GT(area(), alone);
  for (const glm::dvec3& corner : beyond.corners()) {
    const glm::dvec4 clip = cascades().items.back().world_to_clip * glm::dvec4(corner, 1);
    EXPECT_LE(std::max(std::abs(clip.x), std::abs(clip.y)), 1.0);
  }
}

// A long strip of ground, seen along its length and aslant to the light's axes.
TriangleScene strip() {
  TriangleScene scene = half_plane_over_ground(128);
  scene.view = glm::lookAt(glm::vec3(-1.6f, 1.4f, -1.8f), glm::vec3(0, 0, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.3f, 1, 0.1f);
  return scene;
}

// The sum over the pixels of visibility · (1 − visibility), which grows with the width of penumbrae.
double softness(const Shadowed& picture) {
  double sum = 0;
  for (const float visibility : picture.visibilities()) sum += visibility * (1.0 - visibility);
  return sum;
}

TEST_F(ShadowVisible, TurnedAndLongTexelsDoNotChangeSoftness) {
  const TriangleScene scene = strip();
  for (const char* technique : {"pcss", "slices", "backprojection", "vssm", "brute_force"}) {
    const auto with = [&](const char* fit, float angle) {
      ParamSet own = params(fit);
      own.set("technique", std::string(technique));
      own.set("cascades.count", 1);  // as long as the strip
      own.set("cascades.size", 1024);
      own.set("sun.angle", angle);
      return own;
    };
    for (const float angle : {2.0f, 6.0f}) {
      const double expected = softness(renderer_->render(scene, with("stable", angle)));
      const double found = softness(renderer_->render(scene, with("visible", angle)));
      const glm::vec2 texel = cascades().texel(0);
      EXPECT_NE(cascades().turn, 0);
      EXPECT_GT(std::max(texel.x, texel.y), 1.2f * std::min(texel.x, texel.y));
      EXPECT_GT(expected, 100) << "the picture shows too little of a penumbra";
      EXPECT_NEAR(found / expected, 1, 0.03) << technique << ", " << angle << " degrees";
    }
  }
}

// A square light has sides, which must not turn with the view.
TEST_F(ShadowVisible, ASquareLightIsNotTurned) {
  ParamSet square = params();
  square.set("sun.shape", std::string("square"));
  renderer_->render(strip(), square);
  EXPECT_EQ(cascades().turn, 0);
}

TEST_F(ShadowVisible, AreNotLookedForWhereNothingReadsMaps) {
  ParamSet none = params();
  none.set("technique", std::string("none"));
  renderer_->render(strip(), none);
  const glm::vec2 half = cascades().items.back().half_extent;
  none.set("cascades.fit", std::string("stable"));
  renderer_->render(strip(), none);
  EXPECT_EQ(cascades().items.back().half_extent, half);
}

// What a frame kept of the last one's maps must not hide that another part of the scene is seen.
TEST_F(ShadowVisible, FollowTheSceneWhileCameraAndBoundsRest) {
  TriangleScene scene = small_in_large();
  ParamSet kept = params();
  const auto rest = [&](shadow::Inputs& in) {
    in.view.last_view = in.view.view;
    in.view.last_projection = in.view.projection;
    in.moved = shadow::Box{{-50, -10, -50}, {50, 50, 50}};
  };
  scene.casters = shadow::Box{{-50, -10, -50}, {50, 50, 50}};
  renderer_->render(scene, kept, rest);
  for (Triangle& triangle : scene.triangles) {
    for (glm::vec3* corner : {&triangle.a, &triangle.b, &triangle.c}) corner->x *= 0.25f;
  }
  const Shadowed narrow = renderer_->render(scene, kept, rest);
  EXPECT_LE(excess_width(shown(narrow)), 1.15);
  TriangleRenderer fresh;
  EXPECT_EQ(narrow.mask, fresh.render(scene, kept, rest).mask);
}

}  // namespace
}  // namespace penumbra::test

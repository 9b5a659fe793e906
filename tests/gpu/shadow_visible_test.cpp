// Maps that are fitted to what the view's depth texture shows (cascades.fit).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "gpu/gl_calls.h"
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

// A ground that the view shows for 200 m.
TEST_F(ShadowVisible, CascadesEndAtTheirDistance) {
  TriangleScene scene = small_in_large();
  scene.triangles.clear();
  scene.add_quad({-100, 0, 10}, {200, 0, 0}, {0, 0, -210});
  scene.view = glm::lookAt(glm::vec3(0, 2, 0), glm::vec3(0, 0, -8), glm::vec3(0, 1, 0));
  ParamSet near = params();
  const Shadowed picture = renderer_->render(scene, near);
  EXPECT_LE(excess_width(shown(picture)), 1.15);
  near.set("cascades.distance", 20.0f);
  renderer_->render(scene, near);
  shadow::LightBounds bounds;
  for (const glm::vec3& point : picture.points) {
    if (-(scene.view * glm::vec4(point, 1)).z > 20 || point.y < -1 || point.y > 1) continue;
    const glm::dvec3 place = cascades().world_to_light * (glm::dvec3(point) - cascades().anchor);
    bounds = {glm::min(bounds.low, place), glm::max(bounds.high, place)};
  }
  EXPECT_LE(excess_width(bounds), 1.25);
}

// An orthographic view may show what lies behind its camera: distances count from the nearest receiver.
TEST_F(ShadowVisible, AnOrthographicCameraMayBeAmongWhatItShows) {
  TriangleScene scene = small_in_large();
  scene.triangles.clear();
  scene.add_quad({-100, 0, 100}, {200, 0, 0}, {0, 0, -200});
  std::vector<glm::vec2> expected;  // half widths of cascades
  for (const float forwards : {0.0f, 30.0f, 55.0f}) {
    const glm::vec3 way = glm::normalize(glm::vec3(0, -2, -8)), eye = glm::vec3(0, 10, 40) + forwards * way;
    scene.view = glm::lookAt(eye, eye + way, glm::vec3(0, 1, 0));
    scene.projection = orthographic(8, 8, -forwards, 100 - forwards);
    EXPECT_LE(excess_width(shown(renderer_->render(scene, params()))), 1.15) << forwards;
    std::vector<glm::vec2> found;
    for (const shadow::Cascade& cascade : cascades().items) found.push_back(cascade.half_extent);
    if (forwards == 0) expected = found;
    ASSERT_GT(found.size(), 1u);
    ASSERT_EQ(found.size(), expected.size()) << forwards;
    for (std::size_t i = 0; i < found.size(); ++i)
      EXPECT_LT(glm::length(found[i] - expected[i]), 0.01f * expected[i].x) << forwards << ", cascade " << i;
  }
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

constexpr std::size_t ground_triangles = 2;

// A box of 40 cm on a ground whose borders are not seen.
TriangleScene small_box_in_large() {
  TriangleScene scene = small_in_large();
  scene.width = scene.height = 512;
  scene.triangles.clear();
  scene.add_quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100});
  scene.receivers = scene.casters = shadow::Box{{-50, 0, -50}, {50, 0.4f, 50}};  // no wider than what they hold
  scene.add_box({-0.2f, 0, -0.2f}, {0.2f, 0.4f, 0.2f});
  return scene;
}

// With maps of which the small ones, too, have texels that are small beside what is seen.
ParamSet fine_params(ParamSet params) {
  params.set("cascades.size", 1024);
  return params;
}

// Pixels that differ by more than a quarter.
std::ptrdiff_t differing(const Shadowed& one, const Shadowed& other) {
  const std::vector<float> a = one.visibilities(), b = other.visibilities();
  return std::inner_product(a.begin(), a.end(), b.begin(), std::ptrdiff_t{0}, std::plus<>(),
                            [](float x, float y) { return std::ptrdiff_t{std::abs(x - y) > 0.25f}; });
}

std::ptrdiff_t dark(const Shadowed& picture) {
  const std::vector<float> seen = picture.visibilities();
  return std::ranges::count_if(seen, [](float visibility) { return visibility < 0.5f; });
}

double longest_texel(const shadow::Cascades& cascades, int index) {
  const glm::vec2 texel = cascades.texel(index);
  return std::max(texel.x, texel.y);
}

TEST_F(ShadowVisible, TexelsGoToPenumbrae) {
  const TriangleScene scene = small_box_in_large();
  const Shadowed visible = renderer_->render(scene, fine_params(params()));
  const double of_visible = longest_texel(cascades(), 0);
  const Shadowed penumbrae = renderer_->render(scene, fine_params(params("penumbrae")));
  EXPECT_LE(longest_texel(cascades(), 0), 0.6 * of_visible);
  EXPECT_LE(excess_width(shown(penumbrae)), 1.15);  // the last cascade holds all
  // Whatever may be in a penumbra lies in a finer cascade.
  const shadow::Cascade& finest = cascades().items.front();
  int partly_lit = 0;
  for (int y = 0; y < penumbrae.height; ++y) {
    for (int x = 0; x < penumbrae.width; ++x) {
      const float seen = penumbrae.visibility(x, y);
      if (penumbrae.sky(x, y) || seen < 0.05f || seen > 0.95f) continue;
      ++partly_lit;
      const glm::dvec4 clip = finest.world_to_clip * glm::dvec4(glm::dvec3(penumbrae.point(x, y)), 1);
      EXPECT_LE(std::max(std::abs(clip.x), std::abs(clip.y)), 1.0) << x << ", " << y;
    }
  }
  EXPECT_GT(partly_lit, 10);
  EXPECT_GT(dark(penumbrae), 300);
  EXPECT_LE(differing(penumbrae, visible), dark(penumbrae) / 20);
}

TEST_F(ShadowVisible, AllIsFittedToWhereNoPenumbraIsLookedFor) {
  const TriangleScene scene = small_box_in_large();
  const auto cascades_with = [&](const char* fit, const char* technique, int count) {
    ParamSet own = fine_params(params(fit));
    own.set("technique", std::string(technique));
    own.set("cascades.count", count);
    renderer_->render(scene, own);
    std::vector<glm::vec2> extents;
    for (const shadow::Cascade& cascade : cascades().items) extents.push_back(cascade.half_extent);
    return extents;
  };
  // One technique decides no tiles, and a single map holds all.
  EXPECT_EQ(cascades_with("penumbrae", "brute_force", 4), cascades_with("visible", "brute_force", 4));
  EXPECT_EQ(cascades_with("penumbrae", "pcss", 1), cascades_with("visible", "pcss", 1));
  EXPECT_NE(cascades_with("penumbrae", "pcss", 4), cascades_with("visible", "pcss", 4));
}

TEST_F(ShadowVisible, ShadowsAreTheSameWithMapsForPenumbrae) {
  struct Case {
    const char* what;
    std::vector<const char*> settings;
    bool normals = true;
  };
  const TriangleScene scene = small_box_in_large();
  for (const Case& way :
       {Case{"a wide sun", {"sun.angle=6"}}, Case{"a square sun", {"sun.angle=4", "sun.shape=square"}},
        Case{"no normals", {"sun.angle=2"}, false}, Case{"a quarter of the pixels", {"sun.angle=4", "mask.scale=2"}},
        Case{"all tiles computed", {"mask.tiles=false"}}, Case{"two layers", {"technique=slices", "maps.layers=2"}},
        Case{"a history", {"technique=slices", "denoiser=history_and_filters", "history.reuse=true"}}}) {
    const auto draw = [&](const char* fit) {
      ParamSet own = fine_params(params(fit));
      for (const char* setting : way.settings) own.assign(setting);
      return renderer_->render(scene, own, [&](shadow::Inputs& in) {
        if (!way.normals) in.normals = {};
      });
    };
    const Shadowed expected = draw("visible"), found = draw("penumbrae");
    EXPECT_GT(dark(expected), 300) << way.what;
    EXPECT_LE(differing(found, expected), dark(expected) / 20) << way.what;
  }
}

// Each light of each view has its own.
TEST_F(ShadowVisible, LightsAndViewsHaveTheirOwnPenumbrae) {
  const TriangleScene scene = small_box_in_large();
  const std::array lights{shadow::Light{.source = shadow::Sun{scene.to_light}},
                          shadow::Light{.id = 1, .source = shadow::Sun{sun_direction(-60, 30)}}};
  const auto finest = [&](int view, std::span<const shadow::Light> of) {
    renderer_->render(scene, fine_params(params("penumbrae")), [&](shadow::Inputs& in) {
      in.view.id = view;
      in.lights = of;
    });
    std::vector<glm::vec2> extents;
    for (const shadow::LightFrame& light : renderer_->mask().lights)
      extents.push_back(light.projection.cascades().items.front().half_extent);
    return extents;
  };
  const glm::vec2 first = finest(0, std::span(lights).first(1)).at(0);
  const glm::vec2 second = finest(1, std::span(lights).last(1)).at(0);
  EXPECT_NE(first, second);
  EXPECT_EQ(finest(0, lights), (std::vector{first, second}));
  EXPECT_EQ(finest(1, lights), (std::vector{first, second}));
}

// As for a mirror, or the halves of a split screen; and where the resolution of a view varies.
TEST_F(ShadowVisible, ViewsOfDifferentSizesMakeNoTextureInTurn) {
  TriangleScene large = small_box_in_large(), small = large;
  small.width = large.width / 2 + 8;
  for (const char* fit : {"visible", "penumbrae"}) {
    std::map<std::string, int> made;
    for (int frame = 0; frame < 8; ++frame) {
      std::optional<GlCalls> calls;
      const int view = frame % 2;
      renderer_->render(
          view == 0 ? large : small, fine_params(params(fit)),
          [&](shadow::Inputs& in) {
            in.view.id = view;
            in.view.last_view = in.view.view;
            in.view.last_projection = in.view.projection;
            if (frame >= 6) in.viewport = {0, 0, in.depth.width - 16, in.depth.height - 16};
            calls.emplace(GlCalls::Kind::creations);
          },
          [&] {
            if (frame >= 4) made.merge(calls->counts());
            calls.reset();
          });
    }
    EXPECT_EQ(made, (std::map<std::string, int>())) << fit;
  }
}

// While only sky is seen the small maps rest, and what moves meanwhile is not lost.
TEST_F(ShadowVisible, PenumbraeAreFoundAgainBelowTheSky) {
  TriangleScene scene = small_box_in_large();
  const gl::Texture sky("sky", {.format = GL_DEPTH_COMPONENT32F, .width = scene.width, .height = scene.height});
  const float far = 0;
  gl::glClearTexImage(sky.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
  const auto frame = [&](bool shows_sky, const shadow::Box& moved) {
    return renderer_->render(scene, fine_params(params("penumbrae")), [&](shadow::Inputs& in) {
      in.view.last_view = in.view.view;
      in.view.last_projection = in.view.projection;
      in.moved = moved;
      if (shows_sky) in.depth.id = sky.id();
    });
  };
  const shadow::Box nothing{glm::vec3(1), glm::vec3(-1)}, all{{-50, 0, -50}, {50, 0.4f, 50}};
  frame(false, nothing);
  scene.move_from(ground_triangles, {1.5f, 0, 0});
  frame(true, all);
  const Shadowed found = frame(false, nothing);
  TriangleRenderer fresh;
  const Shadowed expected = fresh.render(scene, fine_params(params("penumbrae")));
  EXPECT_GT(dark(expected), 300);
  EXPECT_EQ(found.mask, expected.mask);
}

// Parameters that change while only sky is seen reach the small maps, too.
TEST_F(ShadowVisible, SmallMapsFollowParametersThatChangeBelowTheSky) {
  const TriangleScene scene = small_box_in_large();
  const gl::Texture sky("sky", {.format = GL_DEPTH_COMPONENT32F, .width = scene.width, .height = scene.height});
  const float far = 0;
  gl::glClearTexImage(sky.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
  const auto frame = [&](TriangleRenderer& renderer, float angle, bool shows_sky) {
    ParamSet own = fine_params(params("penumbrae"));
    own.set("sun.angle", angle);
    return renderer.render(scene, own, [&](shadow::Inputs& in) {
      if (shows_sky) in.depth.id = sky.id();
    });
  };
  frame(*renderer_, 0.53f, false);
  frame(*renderer_, 12, true);
  const Shadowed found = frame(*renderer_, 12, false);
  const glm::vec2 extent = cascades().items.front().half_extent;
  TriangleRenderer fresh;
  EXPECT_EQ(found.mask, frame(fresh, 12, false).mask);
  EXPECT_EQ(extent, fresh.mask().lights.front().projection.cascades().items.front().half_extent);
}

TEST_F(ShadowVisible, MapsThatAreDrawnFirstAreReleased) {
  const TriangleScene scene = small_box_in_large();
  const auto first_maps = [&] {
    const auto names = renderer_->device().names("");
    return std::ranges::count_if(
        names, [](std::string_view name) { return name.find("first maps") != std::string_view::npos; });
  };
  renderer_->render(scene, fine_params(params("penumbrae")));
  EXPECT_GT(first_maps(), 0);
  for (const char* fit : {"visible", "stable"}) {
    renderer_->render(scene, fine_params(params("penumbrae")));
    renderer_->render(scene, fine_params(params(fit)));
    EXPECT_EQ(first_maps(), 0) << fit;
  }
  // Of another technique nothing stays behind.
  renderer_->render(scene, fine_params(params("penumbrae")));
  const auto expected = first_maps();
  ParamSet other = fine_params(params("penumbrae"));
  other.set("technique", std::string("vssm"));
  renderer_->render(scene, other);
  renderer_->render(scene, fine_params(params("penumbrae")));
  EXPECT_EQ(first_maps(), expected);
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

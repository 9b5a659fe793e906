// Filters of the mask, on constructed masks: how wide they blur, which edges they keep, which pixels they do not
// change.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

// Two pairs of visibility and blocker distance, and which pixels have the second one.
constexpr const char* pattern_text = R"(
#include "shadow/light.glsl"

float read_radius(Receiver receiver, Light light) { return 0.0; }

bool is_marked(Receiver receiver) {
  ivec2 pixel = ivec2(receiver.pixel);
  if (pattern_marks == pattern_marks_right) return receiver.pixel.x >= 0.5 * shadow.viewport.z;
  if (pattern_marks == pattern_marks_top) return receiver.pixel.y >= 0.5 * shadow.viewport.w;
  if (pattern_marks == pattern_marks_dots) return pixel.x % 5 == 2 && pixel.y % 5 == 2;
  if (pattern_marks == pattern_marks_low) return receiver.position.z > pattern_depth;
  return false;
}

Visibility visibility(Receiver receiver, Light light) {
  bool marked = is_marked(receiver);
  float distance_to = marked ? pattern_marked_distance : pattern_distance;
  return Visibility(marked ? pattern_marked_visibility : pattern_visibility, penumbra_radius(receiver, distance_to, light),
                    distance_to, false, marked && pattern_marked_noise == 0.0);
}
)";

shadow::Technique pattern() {
  const auto number = [](const char* name, float value) {
    return Param{name, value, 0, 100, "", "Value.", ParamBinding::uniform};
  };
  return {.name = "pattern",
          .summary = "Made-up masks.",
          .source = "made up",
          .glsl = "test/pattern.glsl",
          .needs = {},
          .params = {{"pattern.marks",
                      std::string("none"),
                      0,
                      0,
                      "",
                      "Which pixels are marked.",
                      ParamBinding::uniform,
                      {"none", "right", "top", "dots", "low"}},
                     number("pattern.depth", 0),
                     number("pattern.visibility", 0),
                     number("pattern.marked_visibility", 1),
                     number("pattern.distance", 4),
                     number("pattern.marked_distance", 4),
                     number("pattern.marked_noise", 1)}};
}

// A filter that a program adds is one value and one GLSL file.
shadow::Filter inverse() {
  return {.name = "inverse",
          .summary = "Light for shadow.",
          .source = "made up",
          .glsl = "test/inverse.glsl",
          .border = {{0, 0}}};
}

constexpr const char* inverse_text = R"(
#include "shadow/drivers/filter.glsl"
uint filtered(ivec2 pixel) { return with_visibility(texel_at(pixel), 1.0 - texel_visibility(texel_at(pixel))); }
)";

std::vector<shadow::Filter> filters() {
  std::vector<shadow::Filter> all = shadow::built_in_filters();
  all.push_back(inverse());
  return all;
}

const std::vector<std::string> drivers{"fragment", "compute"};

class ShadowFilter : public GpuTest {
 protected:
  ShadowFilter()
      : renderer(shadow::Registry({.techniques = {pattern()}, .filters = filters()})), params(renderer.params()) {
    renderer.device().shaders.files().put("test/pattern.glsl", pattern_text);
    renderer.device().shaders.files().put("test/inverse.glsl", inverse_text);
    params.set("sun.angle", 8.0f);
    params.set("cascades.count", 1);
  }

  Shadowed draw(const TriangleScene& scene, const std::string& marks, const std::string& filter) {
    params.set("pattern.marks", marks);
    params.set("filter.visibility", filter);
    return renderer.render(scene, params);
  }

  TriangleRenderer renderer;
  ParamSet params;
};

// A ground of 20 m, seen from 5 m.
TriangleScene ground(int side, float elevation_degrees, bool in_perspective) {
  TriangleScene scene;
  scene.add_quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20});
  scene.width = scene.height = side;
  scene.view = glm::lookAt(5.0f * sun_direction(0, elevation_degrees), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection =
      in_perspective ? perspective(0.5f, 1, 0.1f) : orthographic(5 * std::tan(0.25f), 5 * std::tan(0.25f), 0.1f, 50);
  return scene;
}

// Standard deviation, pixels, of the kernel that blurred a step along the picture's middle row or column.
double blur_of(const Shadowed& shadowed, bool of_column) {
  const int side = shadowed.width;
  double sum = 0;
  double squares = 0;
  for (int i = 0; i + 1 < side; ++i) {
    const auto value = [&](int at) {
      return of_column ? shadowed.visibility(side / 2, at) : shadowed.visibility(at, side / 2);
    };
    const double rise = value(i + 1) - value(i);
    const double from_step = i + 1 - 0.5 * side;
    sum += rise;
    squares += rise * from_step * from_step;
  }
  EXPECT_NEAR(sum, 1, 0.01);
  return std::sqrt(squares / sum);
}

// Metres: a tenth of the penumbra's width 2 · tan(4°) · 4 m.
constexpr double sigma_metres = 0.1 * 2 * 0.0699268 * 4;

TEST_F(ShadowFilter, TwiceTheHeightBlursTwiceAsManyPixels) {
  const double metres_across = 2 * 5 * std::tan(0.25);
  for (const bool in_perspective : {true, false}) {
    for (const std::string filter : {"box", "gaussian", "bilateral", "bilateral_separable"}) {
      for (const int side : {64, 128, 256}) {
        const TriangleScene scene = ground(side, 89.9f, in_perspective);
        const double sigma = sigma_metres * side / metres_across;
        const double x = blur_of(draw(scene, "right", filter), false);
        const double y = blur_of(draw(scene, "top", filter), true);
        std::printf("%s, %d pixels: sigma %.2f, blur %.2f and %.2f\n", filter.c_str(), side, sigma, x, y);
        // A Gaussian that is cut off at 2σ has 0.88 σ.
        EXPECT_NEAR(x / sigma, filter == "box" ? 1 : 0.9, 0.06) << filter << side;
        EXPECT_NEAR(y / sigma, filter == "box" ? 1 : 0.9, 0.06) << filter << side;
      }
    }
  }
}

TEST_F(ShadowFilter, ATiltedPlaneIsBlurredAsMuchAsItIsSeen) {
  for (const bool in_perspective : {true, false}) {
    for (const float elevation : {60.0f, 30.0f, 15.0f}) {
      const TriangleScene scene = ground(256, elevation, in_perspective);
      for (const std::string filter : {"gaussian", "bilateral_separable"}) {
        const double x = blur_of(draw(scene, "right", filter), false);
        const double y = blur_of(draw(scene, "top", filter), true);
        EXPECT_NEAR(y / x, std::sin(glm::radians(elevation)), 0.05) << filter << " at " << elevation;
      }
    }
  }
}

TEST_F(ShadowFilter, TheWidthIsCapped) {
  params.set("filter.max_sigma", 2.0f);
  EXPECT_NEAR(blur_of(draw(ground(256, 89.9f, true), "right", "bilateral_separable"), false), 1.8, 0.15);
}

// A slab of 2 × 2 m before a floor 2 m below, and the sky.
TriangleScene slab_over_floor() {
  TriangleScene scene;
  scene.add_quad({-6, 0, 3}, {12, 0, 0}, {0, 0, -8});
  scene.add_quad({-1, 2, 1}, {2, 0, 0}, {0, 0, -2});
  scene.view = glm::lookAt(glm::vec3(1, 5, 6), glm::vec3(0, 1, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.9f, 1, 0.1f);
  scene.width = scene.height = 96;
  return scene;
}
constexpr float between = 4;  // metres below the camera: slab 3, floor 5

TEST_F(ShadowFilter, PixelsWithoutNoiseAreKept) {
  const TriangleScene scene = ground(64, 89.9f, true);
  for (const std::string& driver : drivers) {
    params.set("driver", driver);
    for (const std::string filter :
         {"median_visibility", "box", "gaussian", "bilateral", "bilateral_separable", "isophote"}) {
      params.set("pattern.marked_noise", 0.0f);
      const Shadowed kept = draw(scene, "dots", filter);
      params.set("pattern.marked_noise", 1.0f);
      const Shadowed filtered = draw(scene, "dots", filter);
      for (int y = 2; y < 64; y += 5) {
        for (int x = 2; x < 64; x += 5) {
          ASSERT_EQ(kept.visibility(x, y), 1) << filter << " in " << driver << " at " << x << " " << y;
          ASSERT_LT(filtered.visibility(x, y), 0.9) << filter << " in " << driver << " at " << x << " " << y;
        }
      }
      // Neighbours are still averaged with them.
      if (filter == "median_visibility") continue;
      EXPECT_GT(kept.visibility(33, 32), 0) << filter << " in " << driver;
    }
  }
}

TEST_F(ShadowFilter, NothingBleedsAcrossADepthEdge) {
  params.set("pattern.depth", between);
  for (const float lit_floor : {0.0f, 1.0f}) {
    params.set("pattern.visibility", 1 - lit_floor);
    params.set("pattern.marked_visibility", lit_floor);
    const std::vector<float> apart = draw(slab_over_floor(), "low", "none").visibilities();
    for (const std::string& driver : drivers) {
      params.set("driver", driver);
      for (const std::string filter :
           {"median_visibility", "box", "gaussian", "bilateral", "bilateral_separable", "isophote"}) {
        const std::vector<float> filtered = draw(slab_over_floor(), "low", filter).visibilities();
        float most = 0;
        for (size_t i = 0; i < apart.size(); ++i) most = std::max(most, std::abs(filtered[i] - apart[i]));
        if (filter != "box" && filter != "gaussian") {
          EXPECT_LE(most, 1.0f / 255) << filter;
        } else {
          EXPECT_GT(most, 0.25f) << filter;
        }
      }
    }
  }
}

// A floor before a wall, which are seen at the same angle.
TriangleScene floor_and_wall() {
  TriangleScene scene;
  scene.add_quad({-6, 0, 6}, {12, 0, 0}, {0, 0, -6});
  scene.add_quad({-6, 0, 0}, {12, 0, 0}, {0, 6, 0});
  scene.view = glm::lookAt(glm::vec3(0, 3, 3), glm::vec3(0), glm::vec3(0, 1, 0));
  scene.projection = orthographic(1, 1, 0.1f, 20);
  scene.width = scene.height = 64;
  return scene;
}

TEST_F(ShadowFilter, IsophotesLeaveWhatIsLitOrDarkWithItsNeighboursOnItsPlane) {
  for (const std::string& driver : drivers) {
    params.set("driver", driver);
    const TriangleScene plane = ground(64, 89.9f, true);
    const Shadowed step = draw(plane, "right", "none"), filtered = draw(plane, "right", "isophote");
    int changed = 0;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const bool changes = filtered.visibility(x, y) != step.visibility(x, y);
        changed += changes ? 1 : 0;
        ASSERT_TRUE(!changes || x == 31 || x == 32) << driver << " at " << x << " " << y;
      }
    }
    EXPECT_GT(changed, 64) << driver;
    params.set("pattern.depth", 2.99f);  // metres below the camera: the floor 3
    const TriangleScene crease = floor_and_wall();
    const std::vector<float> apart = draw(crease, "low", "none").visibilities();
    EXPECT_EQ(draw(crease, "low", "isophote").visibilities(), apart) << driver;
    EXPECT_NE(apart.front(), apart.back());
  }
}

TEST_F(ShadowFilter, AConstantMaskStaysConstant) {
  params.set("pattern.visibility", 0.37f);
  for (const std::string& driver : drivers) {
    params.set("driver", driver);
    for (const std::string filter :
         {"median_visibility", "box", "gaussian", "bilateral", "bilateral_separable", "isophote"}) {
      const TriangleScene scene = ground(70, 40, true);
      for (const float visibility : draw(scene, "none", filter).visibilities()) {
        ASSERT_NEAR(visibility, 0.37f, 3e-4f) << filter;  // the mask stores half floats
      }
    }
  }
}

TEST_F(ShadowFilter, TheWidestKernelsAreTheSameInComputeShaders) {
  params.set("pattern.distance", 100.0f);
  params.set("pattern.marked_distance", 100.0f);
  for (const std::string filter : {"box", "gaussian", "bilateral", "bilateral_separable", "isophote"}) {
    for (const int taps : {1, 3, 6, 48}) {
      params.set("filter.taps", taps);
      params.set("driver", std::string("fragment"));
      const std::vector<float> mask = draw(ground(150, 89.9f, true), "dots", filter).mask;
      params.set("driver", std::string("compute"));
      EXPECT_EQ(draw(ground(150, 89.9f, true), "dots", filter).mask, mask) << filter << ", " << taps << " taps";
    }
  }
}

std::vector<float> distances(const Shadowed& shadowed) {
  std::vector<float> all;
  for (size_t i = 2; i < shadowed.mask.size(); i += 4) all.push_back(shadowed.mask[i]);
  return all;
}

TEST_F(ShadowFilter, TheMedianRemovesSingleWrongDistances) {
  params.set("filter.penumbra", std::string("median"));
  for (const std::string& driver : drivers) {
    params.set("driver", driver);
    for (const float wrong : {0.0f, 1.0f, 9.0f}) {
      params.set("pattern.marked_distance", wrong);
      const Shadowed shadowed = draw(ground(61, 50, true), "dots", "none");
      for (const float one : distances(shadowed)) ASSERT_EQ(one, 4);
      EXPECT_EQ(shadowed.visibility(2, 2), 1) << "it is no filter of visibility";
      EXPECT_EQ(shadowed.visibility(3, 2), 0);
    }
  }
}

TEST_F(ShadowFilter, TheMedianOfVisibilityRemovesSingleWrongOnes) {
  for (const std::string& driver : drivers) {
    params.set("driver", driver);
    for (const float wrong : {0.0f, 0.4f, 1.0f}) {
      params.set("pattern.visibility", 0.5f);
      params.set("pattern.marked_visibility", wrong);
      ASSERT_NEAR(draw(ground(61, 50, true), "dots", "none").visibility(2, 2), wrong, 3e-4f);
      for (const float one : draw(ground(61, 50, true), "dots", "median_visibility").visibilities())
        ASSERT_NEAR(one, 0.5f, 3e-4f);
    }
  }
}

TEST_F(ShadowFilter, DarkDotsAmongLitPixelsAreFilteredAway) {
  params.set("filter.penumbra", std::string("median"));
  params.set("pattern.visibility", 1.0f);
  params.set("pattern.distance", 0.0f);
  params.set("pattern.marked_visibility", 0.0f);
  for (const std::string filter : {"box", "gaussian", "bilateral", "bilateral_separable", "isophote"}) {
    const std::vector<float> visibilities = draw(ground(61, 89.9f, true), "dots", filter).visibilities();
    EXPECT_GT(*std::ranges::min_element(visibilities), 0.7f) << filter;
  }
}

TEST_F(ShadowFilter, TheMedianKeepsEdges) {
  params.set("pattern.depth", between);
  params.set("pattern.marked_distance", 9.0f);
  for (const std::string marks : {"right", "top", "low"}) {
    params.set("filter.penumbra", std::string("none"));
    const std::vector<float> raw = distances(draw(slab_over_floor(), marks, "none"));
    params.set("filter.penumbra", std::string("median"));
    for (const std::string& driver : drivers) {
      params.set("driver", driver);
      const std::vector<float> filtered = distances(draw(slab_over_floor(), marks, "none"));
      if (marks == "low") {
        EXPECT_EQ(filtered, raw) << "the slab's corners are the slab's";
      } else {
        // Corners where the edge of a mark meets that of another surface may be rounded.
        int differ = 0;
        for (size_t i = 0; i < raw.size(); ++i) differ += filtered[i] != raw[i] ? 1 : 0;
        EXPECT_LE(differ, 8) << marks;
      }
    }
  }
}

TEST_F(ShadowFilter, AnotherFilterIsAValueAndAFile) {
  for (const std::string& driver : drivers) {
    params.set("driver", driver);
    const Shadowed shadowed = draw(ground(32, 60, true), "right", "inverse");
    EXPECT_EQ(shadowed.visibility(3, 16), 1);
    EXPECT_EQ(shadowed.visibility(28, 16), 0);
  }
}

}  // namespace
}  // namespace penumbra::test

// Several lights in one frame: each has a layer of the mask, and the picture is the sum of the pictures with one light
// each.
#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string>

#include "core/log.h"
#include "render_scenes.h"

namespace penumbra::test {
namespace {

class LightsTest : public RenderTest {
 protected:
  LightsTest() {
    params.set_text("technique", "pcss");
    params.set_text("sun.angle", "3");
    params.set("render.sky_light", 0.0f);
    params.set("render.ground_light", 0.0f);
    params.set("exposure.auto", false);
    params.set("exposure.ev", -std::log2(1.2f));  // a luminance of 1 has the value 1 in the picture
    inputs.camera = inputs.last_camera = render::look_at({0, 0, 8}, {0, 0, 0}, 0.5f, 0.01f);
    // A square that hides from each of two suns a different part of a wall.
    scene_.materials.push_back({.base_color = {0.8f, 0.4f, 0.2f, 1}, .metallic = 0, .roughness = 1});
    scene::Primitive quad = square();
    quad.material = 0;
    add_node(scene_, quad, glm::scale(glm::mat4(1), glm::vec3(4)));
    add_node(scene_, quad, glm::translate(glm::scale(glm::mat4(1), glm::vec3(0.4f)), glm::vec3(0, 0, 2)));
  }

  struct Drawn {
    std::vector<float> color;
    std::vector<std::vector<float>> masks;  // visibility by layer
  };

  Drawn draw_with(std::vector<render::FrameLight> lights) {
    inputs.lights = std::move(lights);
    const render::Frame& frame = draw(scene_);
    Drawn drawn{.color = renderer.read_aov("color"), .masks = {}};
    for (int layer = 0; layer < frame.mask.texture->desc().layers; ++layer)
      drawn.masks.push_back(gl::read_floats(*frame.mask.texture, 1, 0, layer));
    return drawn;
  }

  // The pixel that shows a place of the wall.
  static glm::ivec2 place_of(const glm::vec2& wall) {
    const float pixels_per_metre = 0.5f * height / (8 * std::tan(0.25f));
    constexpr glm::vec2 middle(0.5f * width, 0.5f * height);
    return glm::ivec2(middle + pixels_per_metre * glm::vec2(wall.x, -wall.y));
  }

  scene::Scene scene_;
  const render::SunLight warm_{.to_light = glm::normalize(glm::vec3(0.6f, 0, 1)), .illuminance = {3, 2, 1}};
  const render::SunLight cold_{.to_light = glm::normalize(glm::vec3(-0.5f, 0.3f, 1)), .illuminance = {1, 2, 4}};
};

TEST_F(LightsTest, TwoSunsGiveTheSumOfEach) {
  const Drawn a = draw_with({warm_});
  const Drawn b = draw_with({cold_});
  const Drawn both = draw_with({warm_, cold_});
  ASSERT_EQ(both.color.size(), a.color.size());
  for (std::size_t i = 0; i < both.color.size(); ++i) {
    const float sum = a.color[i] + b.color[i];
    // Each of the three was rounded to a half float.
    ASSERT_NEAR(both.color[i], sum, 1.5f * sum / 1024) << i;
  }
}

// But for one step of half floats: a GPU's compiler may order the operations of two programs differently.
void expect_same(const std::vector<float>& a, const std::vector<float>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], std::max(std::abs(b[i]) / 1024, 1e-7f)) << i;
}

float farthest_apart(const std::vector<float>& a, const std::vector<float>& b) {
  float most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

TEST_F(LightsTest, AHiddenSunAddsNothingToWhatOtherLightsShow) {
  params.set("render.sky_light", 0.5f);
  inputs.on_ground = true;
  const render::SunLight hidden{.to_light = glm::normalize(glm::vec3(0, -0.3f, 1)), .illuminance = glm::vec3(1000)};
  for (const bool automatic : {true, false}) {
    SCOPED_TRACE(automatic);
    params.set("exposure.auto", automatic);
    const Drawn alone = draw_with({warm_});
    expect_same(draw_with({warm_, hidden}).color, alone.color);
    expect_same(draw_with({hidden, warm_}).color, alone.color);
    inputs.on_ground = false;
    EXPECT_GT(farthest_apart(draw_with({warm_, hidden}).color, alone.color), 0.1f) << "there, nothing hides it";
    inputs.on_ground = true;
    // The light of the sky is left where there is no other.
    const std::vector<float> night = draw_with({hidden}).color;
    EXPECT_TRUE(std::ranges::all_of(night, [](float value) { return std::isfinite(value); }));
    EXPECT_GT(std::ranges::max(night), 0);
  }
  params.set("render.sky_light", 0.0f);
  const std::vector<float> black = draw_with({hidden}).color;
  EXPECT_TRUE(std::ranges::all_of(renderer.read_display(), [](int value) { return value <= 1; })) << "dither";
  EXPECT_TRUE(std::ranges::all_of(black, [](float value) { return value == 0; }));
}

TEST_F(LightsTest, AHiddenSunIsToldOnceForEachScene) {
  inputs.on_ground = true;
  inputs.light_names = {"day", "evening"};
  const render::SunLight hidden{.to_light = glm::normalize(glm::vec3(0, -0.3f, 1))};
  std::vector<std::string> told;
  const LogSink sink = [&](LogLevel level, std::string_view message) {
    if (level == LogLevel::warning) told.emplace_back(message);
  };
  const ThreadLogSink scope(sink);
  for (std::size_t scene = 1; scene <= 2; ++scene) {
    inputs.told_hidden = std::make_shared<std::set<int>>();
    for (int frame = 0; frame < 2; ++frame) draw_with({warm_, hidden});
    ASSERT_EQ(told.size(), scene);
    EXPECT_NE(told.back().find("'evening' is below the horizon"), std::string::npos) << told.back();
  }
  draw_with({hidden, hidden});
  EXPECT_EQ(told.size(), 3u) << "the other one is told of too";
}

TEST_F(LightsTest, EachLightHasItsOwnLayerOfTheMask) {
  const Drawn a = draw_with({warm_});
  const Drawn b = draw_with({cold_});
  const Drawn both = draw_with({warm_, cold_});
  const Drawn turned = draw_with({cold_, warm_});
  ASSERT_EQ(both.masks.size(), 2u);
  EXPECT_EQ(both.masks[0], a.masks[0]);
  EXPECT_EQ(both.masks[1], b.masks[0]);
  EXPECT_EQ(turned.masks[0], b.masks[0]);
  EXPECT_EQ(turned.masks[1], a.masks[0]);
  // There are pixels that only the first sun reaches, and pixels that only the second reaches.
  int only_a = 0, only_b = 0;
  for (std::size_t i = 0; i < both.masks[0].size(); ++i) {
    only_a += both.masks[0][i] == 1 && both.masks[1][i] == 0 ? 1 : 0;
    only_b += both.masks[0][i] == 0 && both.masks[1][i] == 1 ? 1 : 0;
  }
  EXPECT_GT(only_a, 20);
  EXPECT_GT(only_b, 20);
}

TEST_F(LightsTest, ALightKeepsItsHistoryWhenAnotherOneGoesOut) {
  params.set("history.reuse", true);
  for (const bool named : {true, false}) {
    SCOPED_TRACE(named);
    inputs.light_ids.clear();
    draw_with({warm_, cold_});
    const auto has_history = [&](std::vector<render::FrameLight> lights, const std::vector<int>& ids) {
      inputs.lights = std::move(lights);
      inputs.light_ids = named ? ids : std::vector<int>();
      return renderer.draw(*gpu_scene, inputs, params).mask.lights.back().history;
    };
    has_history({warm_, cold_}, {7, 3});
    EXPECT_TRUE(has_history({warm_, cold_}, {7, 3}));
    // Without a name the light has that of the first, which had another history.
    EXPECT_EQ(has_history({cold_}, {3}), named);
  }
  inputs.light_ids = {1, 2};
  EXPECT_EQ(message_of([&] { draw(scene_); }), "a frame has 1 lights, and 2 ids of lights");
}

TEST_F(LightsTest, BlendedSurfacesAreLitByAllAndShadowedFromTheFirst) {
  // A blended wall of full alpha behind an opaque square.
  scene_.materials.push_back(scene_.materials[0]);
  scene_.materials[1].alpha_mode = scene::AlphaMode::blend;
  scene_.meshes[0].primitives[0].material = 1;
  const glm::ivec2 open(4, 4), of_warm(place_of({-0.66f, 0})), of_cold(place_of({0.62f, -0.2f}));  // their shadows
  const auto expect_at = [](const glm::ivec2& at, const std::vector<float>& seen, const std::vector<float>& expected) {
    for (std::size_t i = 3 * static_cast<std::size_t>(at.y * width + at.x), end = i + 3; i < end; ++i) {
      EXPECT_GT(expected[i], 0);
      EXPECT_NEAR(seen[i], expected[i], 2 * expected[i] / 1024) << at.x << ", " << at.y;
    }
  };
  params.set_text("technique", "none");
  const std::vector<float> warm = draw_with({warm_}).color, cold = draw_with({cold_}).color;
  std::vector<float> sum = warm;
  for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += cold[i];
  params.set_text("technique", "hard");
  const std::vector<float> warm_first = draw_with({warm_, cold_}).color;
  expect_at(open, warm_first, sum);
  expect_at(of_warm, warm_first, cold);
  expect_at(of_cold, warm_first, sum);
  const std::vector<float> cold_first = draw_with({cold_, warm_}).color;
  expect_at(open, cold_first, sum);
  expect_at(of_warm, cold_first, sum);
  expect_at(of_cold, cold_first, warm);
}

TEST_F(LightsTest, BlendedSurfacesThatFaceAwayFromTheLightAreDarkWhateverTheirSmoothNormals) {
  scene_.roots.pop_back();  // the wall alone
  scene_.materials[0].alpha_mode = scene::AlphaMode::blend;
  scene_.meshes[0].primitives[0].normals.assign(4, {0.8f, 0, 0.6f});
  const render::SunLight behind{.to_light = glm::normalize(glm::vec3(1, 0, -0.3f)), .illuminance = glm::vec3(3)};
  params.set_text("technique", "hard");
  EXPECT_EQ(std::ranges::max(draw_with({behind}).color), 0);
}

TEST_F(LightsTest, AFrameWithoutLightsOrWithTooManyIsRefused) {
  EXPECT_EQ(message_of([&] { draw_with({}); }), "a frame has 0 lights; 1 to 64 can be drawn");
  EXPECT_EQ(message_of([&] { draw_with(std::vector<render::FrameLight>(65, warm_)); }),
            "a frame has 65 lights; 1 to 64 can be drawn");
}

}  // namespace
}  // namespace penumbra::test

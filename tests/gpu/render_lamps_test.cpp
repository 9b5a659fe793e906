// Light of spots and point lamps: KHR_lights_punctual in closed form, and several lights at once.
#include <cmath>
#include <tuple>

#include "render_scenes.h"

namespace penumbra::test {
namespace {

class LampLightTest : public RenderTest {
 protected:
  LampLightTest() {
    params.set_text("technique", "none");
    params.set("render.sky_light", 0.0f);
    params.set("render.ground_light", 0.0f);
    params.set("exposure.auto", false);
    params.set("exposure.ev", -std::log2(1.2f));  // a luminance of 1 has the value 1 in the picture
    inputs.camera = inputs.last_camera = render::look_at({0, 0, 8}, {0, 0, 0}, 0.5f, 0.01f);
    // A white wall in the plane z = 0, without gloss: its specular part is what of F0 is left at that roughness.
    scene_.materials.push_back({.base_color = {1, 1, 1, 1}, .metallic = 0, .roughness = 1});
    scene::Primitive quad = square();
    quad.material = 0;
    add_node(scene_, quad, glm::scale(glm::mat4(1), glm::vec3(4)));
  }

  std::vector<float> color_with(std::vector<render::FrameLight> lights) {
    inputs.lights = std::move(lights);
    draw(scene_);
    return renderer.read_aov("color");
  }

  // The wall's point under a pixel, from the centre.
  static glm::vec3 wall_at(int x, int y) {
    const float tangent = 8 * std::tan(0.25f);
    return {(2 * (static_cast<float>(x) + 0.5f) / width - 1) * tangent * width / height,
            (1 - 2 * (static_cast<float>(y) + 0.5f) / height) * tangent, 0};
  }

  // Red, of a pixel.
  static float red(const std::vector<float>& color, int x, int y) {
    return color[3 * static_cast<std::size_t>(y * width + x)];
  }

  scene::Scene scene_;
};

// A sun of one lux in the direction of the lamp gives the same reflection but for its illuminance.
TEST_F(LampLightTest, FallsOffWithTheSquareOfTheDistanceWithinItsRange) {
  constexpr float candela = 10;
  for (const float range : {0.0f, 3.0f}) {
    const glm::vec3 place(0.5f, 0.2f, 2);
    const std::vector<float> lamp =
        color_with({render::LampLight{.position = place, .range = range, .intensity = glm::vec3(candela)}});
    for (const int x : {4, 20, 32, 50, 60}) {
      const glm::vec3 to_lamp = place - wall_at(x, 20);
      const float distance = glm::length(to_lamp);
      const float share = range > 0 ? std::max(1 - std::pow(distance / range, 4.0f), 0.0f) : 1.0f;
      const float illuminance = candela * share / (distance * distance);
      const std::vector<float> sun =
          color_with({render::SunLight{.to_light = to_lamp / distance, .illuminance = glm::vec3(1)}});
      EXPECT_NEAR(red(lamp, x, 20), illuminance * red(sun, x, 20), 2e-3f * illuminance)
          << "range " << range << ", x " << x;
    }
  }
}

TEST_F(LampLightTest, ASpotFadesFromItsInnerToItsOuterCone) {
  const glm::vec3 place(0, 0, 2);
  const render::LampLight point{.position = place};
  render::LampLight spot = point;
  spot.axis = {0, 0, -1};
  spot.inner_cone = glm::radians(15.0f);
  spot.outer_cone = glm::radians(35.0f);
  const std::vector<float> all = color_with({point}), lit = color_with({spot});
  int faded = 0;
  for (int x = 0; x < width; ++x) {
    const glm::vec3 to_lamp = place - wall_at(x, 24);
    const float cosine = to_lamp.z / glm::length(to_lamp);
    const float inner = std::cos(spot.inner_cone), outer = std::cos(spot.outer_cone);
    const float share = std::clamp((cosine - outer) / (inner - outer), 0.0f, 1.0f);
    EXPECT_NEAR(red(lit, x, 24), share * share * red(all, x, 24), 3e-3f * red(all, x, 24)) << x;
    faded += share > 0 && share < 1 ? 1 : 0;
  }
  EXPECT_GT(faded, 8);
}

TEST_F(LampLightTest, ANarrowSpotIsAsBrightAsOthersOnItsAxis) {
  const render::LampLight point{.position = {0, 0, 2}};
  const std::vector<float> all = color_with({point});
  for (const float degrees : {2.0f, 0.5f}) {
    render::LampLight spot = point;
    spot.position += wall_at(width / 2, height / 2);
    spot.axis = {0, 0, -1};
    spot.outer_cone = glm::radians(degrees);
    spot.inner_cone = 0.8f * spot.outer_cone;
    EXPECT_NEAR(red(color_with({spot}), width / 2, height / 2), red(all, width / 2, height / 2),
                0.01f * red(all, width / 2, height / 2))
        << degrees;
  }
}

// Light along the wall is that of a sun in its direction, as near to the wall as that is.
TEST_F(LampLightTest, ALampOnASurfaceGivesFiniteLight) {
  const glm::vec3 wall = wall_at(width / 2, height / 2);
  for (const float radius : {0.0f, 0.5f}) {
    for (const float above : {0.0f, 1e-7f, -1e-7f, 0.1f}) {
      const std::vector<float> color = color_with({render::LampLight{
          .position = wall + glm::vec3(0, 0, above), .radius = radius, .intensity = glm::vec3(1e12f)}});
      for (const float value : color) {
        ASSERT_TRUE(std::isfinite(value)) << radius;
        ASSERT_GE(value, 0) << radius;
      }
      if (above > 0.01f) {
        EXPECT_GT(red(color, width / 2, height / 2), 6e4f) << "less than the greatest that pictures store";
      }
    }
    const glm::vec3 place = wall + glm::vec3(0, 0, 1e-3f);
    const std::vector<float> color =
        color_with({render::LampLight{.position = place, .radius = radius, .intensity = glm::vec3(1e3f)}});
    for (const int x : {width / 2 + 1, width / 2 + 5, width / 2 - 12}) {
      const glm::vec3 to_lamp = place - wall_at(x, height / 2);
      const float away = std::max(glm::length(to_lamp), radius);
      const std::vector<float> sun =
          color_with({render::SunLight{.to_light = glm::normalize(to_lamp), .illuminance = glm::vec3(1)}});
      const float expected = 1e3f / (away * away) * red(sun, x, height / 2);
      EXPECT_NEAR(red(color, x, height / 2), expected, 0.02f * expected) << radius << ", pixel " << x;
    }
  }
}

// Than its radius, or a hundredth of a metre if that is more.
TEST_F(LampLightTest, ALampThatIsNearerLightsNoMoreBrightly) {
  const glm::vec3 wall = wall_at(width / 2, height / 2);
  const std::vector<float> sun = color_with({render::SunLight{.to_light = {0, 0, 1}, .illuminance = glm::vec3(1)}});
  for (const auto& [radius, distance, nearest] :
       {std::tuple(0.5f, 0.25f, 0.5f), {0.5f, 1.0f, 1.0f}, {0, 2e-3f, 1e-2f}}) {
    const std::vector<float> lamp = color_with(
        {render::LampLight{.position = wall + glm::vec3(0, 0, distance), .radius = radius, .intensity = glm::vec3(1)}});
    const float expected = red(sun, width / 2, height / 2) / (nearest * nearest);
    EXPECT_NEAR(red(lamp, width / 2, height / 2), expected, 0.01f * expected) << radius << ' ' << distance;
  }
}

TEST_F(LampLightTest, AutomaticExposureShowsWhatLampsLight) {
  params.set("exposure.auto", true);
  for (const float candela : {0.01f, 10.0f, 1e6f}) {
    const std::vector<float> color =
        color_with({render::LampLight{.position = {0, 0, 2}, .intensity = glm::vec3(candela)}});
    EXPECT_GT(red(color, width / 2, height / 2), 0.2f) << candela;
    EXPECT_LT(red(color, width / 2, height / 2), 4.0f) << candela;
  }
}

// Where two penumbrae cross, and beside a sun: light is added, whatever the technique.
TEST_F(LampLightTest, CrossingPenumbraeAddUp) {
  scene::Primitive quad = square();
  quad.material = 0;
  add_node(scene_, quad, glm::translate(glm::scale(glm::mat4(1), glm::vec3(0.4f)), glm::vec3(0, 0, 2)));
  const render::FrameLight left = render::LampLight{.position = {-1, 0.3f, 2.5f}, .radius = 0.2f};
  const render::FrameLight right = render::LampLight{
      .position = {1, 0, 2.5f}, .radius = 0.3f, .axis = glm::normalize(glm::vec3(-0.3f, 0, -1)), .outer_cone = 1};
  const render::FrameLight sun = render::SunLight{.to_light = {0, 0, 1}, .illuminance = glm::vec3(20)};
  for (const char* technique : {"pcss", "slices_denoised"}) {
    renderer.registry().select(params, technique);
    const std::vector<float> a = color_with({left}), b = color_with({right}), c = color_with({sun});
    const std::vector<float> all = color_with({left, right, sun});
    for (std::size_t i = 0; i < all.size(); ++i) {
      const float sum = a[i] + b[i] + c[i];
      ASSERT_NEAR(all[i], sum, std::max(1.0f / 255, 2 * sum / 1024)) << technique << " " << i;
    }
  }
}

TEST_F(LampLightTest, TheFirstEightLightsCastShadows) {
  params.set_text("technique", "hard");
  // A screen over the left half of what the lamps light.
  scene::Primitive quad = square();
  quad.material = 0;
  add_node(scene_, quad, glm::scale(glm::translate(glm::mat4(1), glm::vec3(-2, 0, 1)), glm::vec3(2)));
  std::vector<render::FrameLight> lights(12, render::LampLight{.position = {0, 0, 3}});
  inputs.lights = lights;
  inputs.camera = inputs.last_camera = render::look_at({0, 0, 0.5f}, {0, 0, 0}, 1.0f, 0.01f);
  EXPECT_EQ(draw(scene_).mask.lights.size(), 8u);
  const std::vector<float> twelve = renderer.read_aov("color");
  params.set_text("technique", "none");
  const std::vector<float> one = color_with({lights[0]});
  const int left = 10, right = 54, y = 20;
  EXPECT_NEAR(red(twelve, right, y), 12 * red(one, right, y), 0.02f * red(twelve, right, y));
  EXPECT_NEAR(red(twelve, left, y), 4 * red(one, left, y), 0.02f * red(twelve, left, y));
}

}  // namespace
}  // namespace penumbra::test

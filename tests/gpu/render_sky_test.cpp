// What pictures show beyond the scene: the sky, the ground around it, and the horizon between them.
#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "render/atmosphere.h"
#include "render_scenes.h"

namespace penumbra::test {
namespace {

float luminance(const glm::vec3& c) { return glm::dot(c, {0.2126f, 0.7152f, 0.0722f}); }

class SkyTest : public RenderTest {
 protected:
  SkyTest() {
    params.set("exposure.auto", false);
    params.set("exposure.ev", -std::log2(1.2f));  // a luminance of 1 has the value 1 in the picture
    sun() = {.to_light = render::direction_to(0.4f, 0.6f), .illuminance = glm::vec3(10)};
    inputs.on_ground = true;
  }

  // A small box's front on ground of the library's own.
  static scene::Scene stage() {
    scene::Scene scene;
    scene.materials.push_back({.base_color = {0.8f, 0.8f, 0.8f, 1}, .metallic = 0});
    scene::Primitive quad = square();
    quad.material = 0;
    add_node(scene, quad, glm::translate(glm::mat4(1), glm::vec3(0, 1, 0)));
    scene::Bounds bounds;
    bounds.add({-1, 0, -1});
    bounds.add({1, 2, 1});
    render::add_ground(scene, bounds);
    return scene;
  }

  // Green of a column of the picture, from top to bottom.
  std::vector<float> column(int x) const {
    const std::vector<float> color = renderer.read_aov("color");
    std::vector<float> values;
    for (int y = 0; y < height; ++y) values.push_back(color[3 * static_cast<std::size_t>(y * width + x) + 1]);
    return values;
  }
};

TEST_F(SkyTest, IsTheModelsInTheLightOfTheSun) {
  inputs.camera = inputs.last_camera = render::look_at({0, 1, 8}, {3, 6, 0}, 1.0f, 0.1f);
  for (const float haze : {0.05f, 0.3f}) {
    params.set("render.haze", haze);
    draw(stage());
    const render::Atmosphere sky(haze);
    // As the parameter has it: a fifth of the sun's light is a level plane's by the sky of a sun that is 45° high.
    double level = 0;
    constexpr int steps = 200;
    for (int i = 0; i < steps; ++i) {
      for (int j = 0; j < steps; ++j) {
        const float sine = (static_cast<float>(i) + 0.5f) / steps, angle = glm::two_pi<float>() * (j + 0.5f) / steps;
        const float radius = std::sqrt(1 - sine * sine);
        const glm::vec3 from(radius * std::cos(angle), sine, radius * std::sin(angle));
        level += luminance(sky.radiance(from, {1, 1, 0})) * sine * glm::two_pi<double>() / (steps * steps);
      }
    }
    const float factor = 0.2f * 10 / static_cast<float>(level);
    int compared = 0;
    for (int y = 0; y < height; y += 5) {
      for (int x = 0; x < width; x += 5) {
        if (ray(x, y).y < 0.05f || pixel("depth", x, y)[0] > 0) continue;
        const glm::vec3 seen = pixel3("color", x, y), expected = factor * sky.radiance(ray(x, y), sun().to_light);
        for (int i = 0; i < 3; ++i)
          EXPECT_NEAR(seen[i], expected[i], 0.03f * expected[i]) << haze << ": " << x << ' ' << y << ' ' << i;
        ++compared;
      }
    }
    EXPECT_GT(compared, 60);
  }
}

// Along a column beside the box, from the camera's feet to the sky: nowhere is there an edge, whether the camera is
// turned about its axis or not, and whatever lights the ground.
TEST_F(SkyTest, TheGroundGoesOnToTheHorizonAndFadesIntoTheSky) {
  const render::FrameLight day = sun();
  for (const std::vector<render::FrameLight>& lights :
       {std::vector{day}, {day, render::LampLight{.position = {2, 3, 2}, .intensity = glm::vec3(20)}}}) {
    inputs.lights = lights;
    for (const int samples : {1, 4}) {
      inputs.samples = samples;
      for (const float height_of_eye : {0.3f, 2.0f, 12.0f}) {
        // From a low eye, all beyond the scene is near the horizon: it is seen through a longer lens.
        inputs.camera = inputs.last_camera = render::look_at({0, height_of_eye, 9}, {3, height_of_eye * 0.75f, 0},
                                                             std::min(0.09f * height_of_eye, 0.8f), 0.1f);
        draw(stage());
        const std::vector<float> depth = renderer.read_aov("depth");
        for (const int x : {width / 2, width - 20}) {
          const std::vector<float> seen = column(x);
          bool ground = false, beyond = false;
          for (int y = 1; y < height; ++y) {
            const bool surface = depth[static_cast<std::size_t>(y * width + x)] > 0;
            ground = ground || surface;
            beyond = beyond || (!surface && ray(x, y).y < 0);
            const float above = seen[static_cast<std::size_t>(y - 1)], here = seen[static_cast<std::size_t>(y)];
            EXPECT_NEAR(here, above, (lights.size() == 1 ? 0.06f : 0.12f) * above)
                << lights.size() << " lights, " << samples << " samples, eye " << height_of_eye << ", " << x << ' '
                << y;
          }
          EXPECT_TRUE(ground) << "eye " << height_of_eye << ", " << x;
          EXPECT_TRUE(beyond) << "eye " << height_of_eye << ", " << x;
        }
      }
    }
  }
}

TEST_F(SkyTest, TheGroundBeyondTheSceneLooksLikeTheOneBelowIt) {
  inputs.camera = inputs.last_camera = render::look_at({0, 2, 9}, {3, 1, 0}, 1.0f, 0.1f);
  const scene::Scene with = stage();
  scene::Scene without = with;
  without.nodes.back().matrix = glm::scale(glm::mat4(1), glm::vec3(0.5f, 1, 0.5f));
  draw(with);
  const std::vector<float> whole = renderer.read_aov("color"), depth = renderer.read_aov("depth");
  draw(without);
  const std::vector<float> part = renderer.read_aov("color"), nearer = renderer.read_aov("depth");
  int compared = 0;
  for (std::size_t i = 0; i < depth.size(); ++i) {
    if (nearer[i] > 0 || depth[i] == 0 || depth[i] > 12) continue;  // where the smaller ground ends, and haze is thin
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) EXPECT_NEAR(part[c], whole[c], 0.06f * whole[c]) << i;
    ++compared;
  }
  EXPECT_GT(compared, 100);
}

// A level view from high above a small scene: in each column the ground below the horizon has all but its own light
// from the haze.
TEST_F(SkyTest, HazeHasTheColourOfTheSkyAsHighAboveTheHorizonAsItIsBelow) {
  inputs.camera = inputs.last_camera = render::look_at({0, 12, 0}, {3, 12, 9}, 0.12f, 0.1f);
  scene::Scene scene;
  add_node(scene, square(), glm::rotate(glm::mat4(1), -glm::half_pi<float>(), {1, 0, 0}));
  draw(scene);
  const std::vector<float> seen = column(width / 2);
  EXPECT_GT(seen.front(), 1.1f * seen[height / 2 - 1]) << "another colour than the horizon";
  for (std::size_t y = 0; y < height / 2; ++y) EXPECT_NEAR(seen[height - 1 - y], seen[y], 0.005f * seen[y]) << y;
}

TEST_F(SkyTest, OrthographicPicturesShowTheGroundWithoutHazeHoweverFarItIs) {
  inputs.camera = render::look_at({0, 2, 9}, {0, 1.97f, 8}, 1.0f, 0.1f);
  inputs.camera.orthographic = true;
  inputs.camera.half_height = 3;
  inputs.last_camera = inputs.camera;
  draw(stage());
  const std::vector<float> seen = column(2), depth = renderer.read_aov("depth");
  int of_scene = 0, beyond = 0;
  for (std::size_t y = 0; y < height; ++y) {
    ++(depth[y * width + 2] > 0 ? of_scene : beyond);
    EXPECT_NEAR(seen[y], seen[0], 0.01f * seen[0]) << y;
  }
  EXPECT_GT(of_scene, 3);
  EXPECT_GT(beyond, 20);
}

TEST_F(SkyTest, LampsMakeNoSky) {
  // Nothing is known of what they light around a scene: it is as bright everywhere, and no haze colours it.
  inputs.lights = {render::LampLight{.position = {0, 3, 3}, .intensity = glm::vec3(40)}};
  inputs.camera = inputs.last_camera = render::look_at({0, 2, 9}, {3, 4, 0}, 1.0f, 0.1f);
  std::vector<float> last;
  for (const float haze : {0.05f, 0.8f}) {
    params.set("render.haze", haze);
    draw(stage());
    const glm::vec3 zenith = pixel3("color", width / 2, 2);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(zenith[i], 0.2f * (40.0f / 4) / glm::pi<float>(), 1e-3f);
    const std::vector<float> color = renderer.read_aov("color");
    if (!last.empty()) {
      EXPECT_EQ(color, last);
    }
    last = color;
  }
}

TEST_F(SkyTest, EverythingIsFiniteUnderEverySunAndCamera) {
  for (const glm::vec3& to_light : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0), glm::vec3(1, 0, 0),
                                    glm::normalize(glm::vec3(1, -0.001f, 0)), glm::normalize(glm::vec3(0, -1, 1))}) {
    sun().to_light = to_light;
    for (const bool orthographic : {false, true}) {
      for (const glm::vec3& target : {glm::vec3(0, 1, 0), glm::vec3(0, -20, 0), glm::vec3(0, 20, 0)}) {
        inputs.camera = inputs.last_camera = render::look_at({0, 1, 9}, target, 1.0f, 0.1f);
        inputs.camera.orthographic = inputs.last_camera.orthographic = orthographic;
        inputs.camera.half_height = inputs.last_camera.half_height = 4;
        draw(stage());
        for (const float value : renderer.read_aov("color")) ASSERT_TRUE(std::isfinite(value) && value >= 0);
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::test

// Reading one pixel of an AOV gives the value that the whole AOV has there.
#include <algorithm>

#include "render_scenes.h"

namespace penumbra::test {
namespace {

class AovPixelTest : public RenderTest {
 protected:
  // A wall with sky above it, and a moving square that shadows it: every AOV has values other than its default.
  AovPixelTest() {
    scene_.materials.push_back({.base_color = {0.8f, 0.4f, 0.2f, 1},
                                .metallic = 0.3f,
                                .roughness = 0.6f,
                                .emissive = {0.1f, 0.2f, 0.3f},
                                .double_sided = true});
    scene::Primitive wall = square();
    wall.material = 0;
    add_node(scene_, wall, glm::scale(glm::translate(glm::mat4(1), glm::vec3(0.3f, -1, -1)), glm::vec3(4, 2, 1)));
    add_node(scene_, wall, glm::rotate(glm::scale(glm::mat4(1), glm::vec3(0.5f)), 0.4f, glm::vec3(1, 1, 0)));
    inputs.last_camera = render::look_at({0.1f, 0.05f, 4.2f}, {0, 0, 0}, 1.0f, 0.01f);
    sun().to_light = glm::normalize(glm::vec3(0.5f, 0.6f, 1));
    inputs.mask_details = true;
    params.set_text("technique", "pcss");
    params.set_text("sun.angle", "4");
    params.set_text("cascades.size", "64");  // so coarse that penumbrae are narrower than a texel
  }

  // The corners, pixels beside the middle row and column, and pixels all over the picture.
  static std::vector<glm::ivec2> pixels() {
    std::vector<glm::ivec2> all{{0, 0}, {width - 1, 0}, {0, height - 1}, {width - 1, height - 1}};
    for (int i = 0; i < 40; ++i) all.emplace_back(i * 37 % width, i * 29 % height);
    return all;
  }

  void expect_pixels_of_pictures() const {
    for (const render::Aov& aov : render::aovs()) {
      const std::vector<float> picture = renderer.read_aov(aov.name);
      const std::size_t channels = aov.channels.size();
      ASSERT_EQ(picture.size(), channels * width * height) << aov.name;
      for (const glm::ivec2& at : pixels()) {
        const auto first =
            picture.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(at.y * width + at.x) * channels);
        EXPECT_EQ(renderer.read_aov(aov.name, at),
                  std::vector<float>(first, first + static_cast<std::ptrdiff_t>(channels)))
            << aov.name << " at " << at.x << ", " << at.y;
      }
    }
  }

  scene::Scene scene_;
};

TEST_F(AovPixelTest, EveryAovIsThatOfThePicture) {
  draw(scene_);
  expect_pixels_of_pictures();
}

TEST_F(AovPixelTest, PixelsAreOfTheLastFrameAndItsHistory) {
  params.set_text("history.reuse", "true");
  draw(scene_);
  inputs.last_camera = inputs.camera;
  inputs.camera = render::look_at({0.3f, 0.1f, 3.8f}, {0, 0, 0}, 1.0f, 0.01f);
  renderer.draw(*gpu_scene, inputs, params);
  expect_pixels_of_pictures();
}

TEST_F(AovPixelTest, ThePicturesOfThisTestTellPixelsApart) {
  params.set_text("history.reuse", "true");
  draw(scene_);
  inputs.last_camera = inputs.camera;
  inputs.camera = render::look_at({0.3f, 0.1f, 3.8f}, {0, 0, 0}, 1.0f, 0.01f);
  renderer.draw(*gpu_scene, inputs, params);
  for (const render::Aov& aov : render::aovs()) {
    const std::vector<float> values = renderer.read_aov(aov.name);
    const auto [least, most] = std::ranges::minmax_element(values);
    EXPECT_LT(*least, *most) << aov.name;
  }
}

TEST_F(AovPixelTest, DetailsThatTheFrameDidNotKeepAreAnError) {
  inputs.mask_details = false;
  draw(scene_);
  for (const render::Aov& aov : render::aovs()) {
    if (!aov.mask_details) {
      renderer.read_aov(aov.name);
      continue;
    }
    EXPECT_NE(message_of([&] { renderer.read_aov(aov.name); }).find(aov.name), std::string::npos) << aov.name;
  }
}

TEST_F(AovPixelTest, AnUnknownNameIsAnError) {
  draw(scene_);
  EXPECT_NE(message_of([&] { renderer.read_aov("shadows", {0, 0}); }).find("did you mean 'shadow'"), std::string::npos);
}

}  // namespace
}  // namespace penumbra::test

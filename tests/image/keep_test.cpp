// With maps.keep the frames of a moving scene and of a camera path are the same to the bit as with all maps drawn anew.

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/read.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "scene/gltf.h"
#include "scene/pose.h"

namespace penumbra::test {
namespace {

constexpr int width = 96, height = 54;

// Draws every frame twice: by a renderer that keeps maps, and by one that draws all of them.
class Keep : public GpuTest {
 protected:
  Keep() {
    scene_ = scene::read_gltf(std::filesystem::path(PENUMBRA_ROOT) / "scenes/moving.glb", image::image_decoder());
    setup_ = render::choose_setup(scene_, scene::pose_at(scene_, 0), {.aspect = static_cast<float>(width) / height});
    gpu_scene_.emplace(device_, scene_);
    inputs_ = {.width = width,
               .height = height,
               .camera = setup_.camera,
               .last_camera = setup_.camera,
               .lights = {setup_.sun}};
  }

  void choose(const std::string& technique, const std::vector<std::string>& assignments) {
    params_ = ParamSet(render::Renderer::params(keeping_.registry()));
    keeping_.registry().select(params_, technique);
    inputs_.mask_details = true;
    params_.set("cascades.size", 256);
    for (const std::string& assignment : assignments) params_.assign(assignment);
  }

  // Draws the next frame; returns how many layers were kept.
  std::size_t frame(const std::string& what) {
    std::size_t kept = 0;
    std::array<std::vector<float>, 2> pixels;
    for (const bool keeps : {true, false}) {
      ParamSet params = params_;
      params.set("maps.keep", keeps);
      render::Renderer& renderer = keeps ? keeping_ : anew_;
      const render::Frame& drawn = renderer.draw(*gpu_scene_, inputs_, params);
      pixels[keeps ? 0 : 1] = gl::read_floats(*drawn.mask.texture, 4);
      const std::vector<float> color = renderer.read_aov("color");
      pixels[keeps ? 0 : 1].insert(pixels[keeps ? 0 : 1].end(), color.begin(), color.end());
      const std::size_t layers = drawn.mask.lights[0].kept_layers.count();
      if (keeps) {
        kept = layers;
      } else {
        EXPECT_EQ(layers, 0u);
      }
    }
    EXPECT_EQ(pixels[0], pixels[1]) << what;
    inputs_.last_time = inputs_.time;
    inputs_.last_camera = inputs_.camera;
    inputs_.cut = false;
    return kept;
  }

  // A path on which the casters, the camera, both, and neither move.
  void follow_path() {
    const auto move_camera = [this] {
      inputs_.camera.view = inputs_.camera.view * glm::rotate(glm::mat4(1), 0.02f, glm::vec3(0, 1, 0));
    };
    frame("the first");
    EXPECT_EQ(frame("nothing moves"), 4u);
    for (int i = 0; i < 3; ++i) {
      inputs_.time += 1 / 24.0;
      frame("casters move");
    }
    for (int i = 0; i < 2; ++i) {
      move_camera();
      frame("the camera moves");
    }
    move_camera();
    inputs_.time += 1 / 24.0;
    frame("both move");
    for (int i = 0; i < 2; ++i) EXPECT_EQ(frame("nothing moves again"), 4u);
    inputs_.time = inputs_.last_time = 2;
    inputs_.cut = true;
    EXPECT_EQ(frame("a jump in time"), 0u);
    inputs_.time = inputs_.last_time = 3;
    EXPECT_EQ(frame("a jump in time without a word about it"), 0u);
    params_.set_text("casters.faces", "front");
    EXPECT_EQ(frame("other faces cast"), 0u);
    EXPECT_EQ(frame("the same faces cast"), 4u);
  }

  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
  scene::Scene scene_;
  render::Setup setup_;
  std::optional<scene::GpuScene> gpu_scene_;
  render::Renderer keeping_{device_}, anew_{device_};
  render::FrameInputs inputs_;
  ParamSet params_;
};

TEST_F(Keep, PcssIsTheSame) {
  choose("pcss", {});
  follow_path();
}

TEST_F(Keep, AHistoryWithAMovementMapIsTheSame) {
  choose("thesis", {});
  follow_path();
}

TEST_F(Keep, AHistoryWithMovedCastersInTheShadowPassIsTheSame) {
  choose("thesis_8x8_compute", {"movement.present=shadow_pass"});
  follow_path();
}

TEST_F(Keep, TwoLayersAreTheSame) {
  choose("slices", {"maps.layers=2"});
  follow_path();
}

}  // namespace
}  // namespace penumbra::test

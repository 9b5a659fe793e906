// Maps in which casters are drawn only where receivers of the view can read give the same pictures, to the bit, as maps
// that are drawn whole.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>
#include <string>
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

// The built-in techniques, none of which says where it reads the maps.
shadow::Registry reading_anywhere() {
  shadow::Registry::Contents contents = shadow::built_in_registry().contents();
  for (shadow::Technique& technique : contents.techniques) technique.reads_light_discs = false;
  return shadow::Registry(std::move(contents));
}

// Draws every frame twice: with maps that are narrowed, and with whole maps that are drawn anew.
class NarrowedMaps : public GpuTest {
 protected:
  struct Drawn {
    std::vector<float> mask;  // of each pixel visibility, penumbra radius, blocker distance and layer
    std::vector<float> color;
    std::size_t texels = 0;  // of the map's layers together that casters are drawn to
    std::size_t kept = 0;    // layers
  };

  void open(const std::string& name, const std::string& technique) {
    scene_ =
        scene::read_gltf(std::filesystem::path(PENUMBRA_ROOT) / "scenes" / (name + ".glb"), image::image_decoder());
    choose(technique);
    show();
  }

  // To be called again when the scene has changed.
  void show() {
    gpu_scene_.emplace(device_, scene_);
    const render::Setup setup =
        render::choose_setup(scene_, scene::pose_at(scene_, 0), {.aspect = static_cast<float>(width) / height});
    inputs_ = {.width = width,
               .height = height,
               .camera = setup.camera,
               .last_camera = setup.camera,
               .lights = {setup.sun},
               .cut = true,
               .mask_details = true};
  }

  void choose(const std::string& technique) {
    params_ = ParamSet(render::Renderer::params(narrow_.registry()));
    narrow_.registry().select(params_, technique);
    params_.set("cascades.size", 512);
  }

  Drawn draw(render::Renderer& renderer, const ParamSet& params) {
    const render::Frame& frame = renderer.draw(*gpu_scene_, inputs_, params);
    Drawn drawn{.mask = gl::read_floats(*frame.mask.texture, 4), .color = renderer.read_aov("color")};
    const shadow::LightFrame& light = frame.mask.lights[0];
    for (int i = 0; i < light.projection.layers(); ++i) {
      const shadow::TexelRange texels = light.projection.drawn_texels(i);
      const glm::ivec2 size = texels.last - texels.first + 1;
      drawn.texels += static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
    }
    drawn.kept = light.kept_layers.count();
    return drawn;
  }

  // The next frame, of narrowed maps.
  Drawn expect_same(const std::string& what) {
    ParamSet anew = params_;
    anew.set("maps.keep", false);
    const Drawn whole = draw(whole_, anew);
    Drawn narrow = draw(narrow_, params_);
    EXPECT_EQ(narrow.mask, whole.mask) << what;
    EXPECT_EQ(narrow.color, whole.color) << what;
    EXPECT_EQ(whole.texels, static_cast<std::size_t>(params_.get_int("cascades.count")) * 512 * 512);
    EXPECT_LT(narrow.texels, whole.texels) << what;
    inputs_.last_camera = inputs_.camera;
    inputs_.last_time = inputs_.time;
    inputs_.cut = false;
    return narrow;
  }

  void compare(const std::string& name, const std::string& technique) {
    open(name, technique);
    for (const float sun_angle : {0.53f, 4.0f}) {
      params_.set("sun.angle", sun_angle);
      expect_same(name + ", " + std::to_string(sun_angle) + " degrees");
    }
  }

  void turn_camera(float radians) {
    inputs_.camera.view = inputs_.camera.view * glm::rotate(glm::mat4(1), radians, glm::vec3(0, 1, 0));
  }

  // A camera that turns, casters that move, and a camera that walks.
  void follow_path(const std::string& technique) {
    for (const bool keeps : {true, false}) {
      open("moving", technique);
      params_.set("maps.keep", keeps);
      for (int i = 0; i < 4; ++i) {
        expect_same("the camera turns");
        turn_camera(0.05f);
      }
      for (int i = 0; i < 3; ++i) {
        inputs_.time += 1 / 24.0;
        expect_same("casters move");
      }
      for (int i = 0; i < 2; ++i) {
        inputs_.time += 1 / 24.0;
        inputs_.camera.view = glm::translate(glm::mat4(1), glm::vec3(0.1f, 0, 0.2f)) * inputs_.camera.view;
        expect_same("both move");
      }
    }
  }

  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
  render::Renderer narrow_{device_}, whole_{device_, reading_anywhere()};
  scene::Scene scene_;
  std::optional<scene::GpuScene> gpu_scene_;
  render::FrameInputs inputs_;
  ParamSet params_;
};

TEST_F(NarrowedMaps, PcssIsTheSame) {
  for (const char* scene : {"courtyard", "foliage", "posts", "thesis"}) compare(scene, "pcss");
}

// What is left out beside the casters' box is empty.
TEST_F(NarrowedMaps, SoAreTheyWhereTheFloorCastsNothing) {
  for (const char* scene : {"posts", "steps"}) {
    for (const char* technique : {"pcss", "slices"}) {
      open(scene, technique);
      const std::size_t with_floor = expect_same(scene).texels;
      const std::vector<scene::Bounds> boxes = scene::node_bounds(scene_, scene::pose_at(scene_, 0));
      const auto width_of = [](const scene::Bounds& box) { return box.empty ? 0 : box.extent().x; };
      const auto widest = std::ranges::max_element(boxes, {}, width_of);
      scene_.nodes[static_cast<std::size_t>(widest - boxes.begin())].casting = scene::CastSetting::off;
      show();
      EXPECT_LT(expect_same(std::string(scene) + " without its floor").texels, with_floor) << scene;
    }
  }
}

TEST_F(NarrowedMaps, HardShadowsAreTheSame) { compare("courtyard", "hard"); }

TEST_F(NarrowedMaps, SlicesAreTheSame) {
  for (const char* scene : {"courtyard", "posts"}) compare(scene, "slices");
}

TEST_F(NarrowedMaps, BruteForceIsTheSame) {
  compare("foliage", "brute_force");
  for (const bool every_texel : {false, true}) {
    open("posts", "brute_force");
    params_.set("brute_force.every_texel", every_texel);
    expect_same(every_texel ? "every texel" : "256 taps");
  }
}

TEST_F(NarrowedMaps, ReceiversThatAreMovedReadTheSameOfASquareSun) {
  for (const char* technique : {"hard", "pcss", "slices", "backprojection", "ssss"}) {
    open("courtyard", technique);
    params_.set("sun.shape", std::string("square"));
    params_.set("sun.angle", 4.0f);
    params_.set("bias.normal_offset", 8.0f);
    expect_same(technique);
  }
}

TEST_F(NarrowedMaps, TheThesisIsTheSame) { compare("foliage", "thesis"); }

TEST_F(NarrowedMaps, SoIsPcssAlongAPath) { follow_path("pcss"); }

TEST_F(NarrowedMaps, SoIsAHistoryWithAMovementMapAlongAPath) { follow_path("thesis_8x8_compute"); }

// A distant camera that sees a part of the scene; the map has all of it, so its projection stays when the camera zooms.
TEST_F(NarrowedMaps, AKeptMapIsDrawnAnewWhereAWiderViewReadsMore) {
  open("posts", "pcss");
  params_.set("cascades.count", 1);
  inputs_.camera.view = glm::translate(glm::mat4(1), glm::vec3(0, 0, -300)) * inputs_.camera.view;
  const auto kept_at = [&](float fov_y) {
    inputs_.camera.fov_y = fov_y;
    return expect_same(std::to_string(fov_y) + " radians").kept;
  };
  EXPECT_EQ(kept_at(0.01f), 0u);
  EXPECT_EQ(kept_at(0.01f), 1u);
  EXPECT_EQ(kept_at(0.008f), 1u);
  EXPECT_EQ(kept_at(0.02f), 0u);
  EXPECT_EQ(kept_at(0.01f), 1u);
  EXPECT_EQ(kept_at(0.03f), 0u);
}

// They read the map where the depth buffer has no receiver: before the sky, and high above the ground.
TEST_F(NarrowedMaps, BlendedSurfacesAreTheSame) {
  open("courtyard", "pcss");
  for (scene::Material& material : scene_.materials) {
    if (material.alpha_mode == scene::AlphaMode::mask) material.alpha_mode = scene::AlphaMode::blend;
  }
  ASSERT_TRUE(std::ranges::any_of(scene_.materials, [](const scene::Material& material) {
    return material.alpha_mode == scene::AlphaMode::blend;
  }));
  show();
  for (const float up : {0.0f, -0.3f, -0.6f}) {
    inputs_.camera.view = glm::rotate(glm::mat4(1), up, glm::vec3(1, 0, 0)) * inputs_.camera.view;
    expect_same("up " + std::to_string(up));
  }
  params_.set("sun.angle", 4.0f);
  expect_same("under a wide sun");
}

}  // namespace
}  // namespace penumbra::test

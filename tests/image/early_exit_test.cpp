// pcss.early_exit spares work and changes no result.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/read.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "scene/gltf.h"
#include "scene/gpu_scene.h"
#include "scene/pose.h"
#include "support/alike.h"

namespace penumbra::test {
namespace {

constexpr int width = 160, height = 90;

// pcss with a mask of 1 where it returned before its two steps, and 0 where it did them. They begin with
// with_surroundings().
constexpr const char* exits_text = R"(
#include "shadow/search.glsl"
#include "shadow/sampling.glsl"
bool did_steps = false;
Receiver noted(Receiver receiver) {
  did_steps = true;
  return receiver;
}
#define with_surroundings(receiver, bias, steepest, light) noted(with_surroundings(receiver, bias, steepest, light))
#define visibility pcss_visibility
#include "shadow/techniques/pcss.glsl"
#undef visibility
#undef with_surroundings
Visibility visibility(Receiver receiver, Light light) {
  pcss_visibility(receiver, light);
  return Visibility(did_steps ? 0.0 : 1.0, 0.0, 0.0, false, false);
}
)";

// The built-in techniques, but with that file for pcss.
shadow::Registry registry_of_exits() {
  shadow::Registry::Contents contents = shadow::built_in_registry().contents();
  for (shadow::Technique& technique : contents.techniques) {
    if (technique.name == "pcss") technique.glsl = "test/pcss_exits.glsl";
  }
  return shadow::Registry(std::move(contents));
}

class EarlyExit : public GpuTest {
 protected:
  EarlyExit() { device_.shaders.files().put("test/pcss_exits.glsl", exits_text); }

  // With the sun at the zenith: where a surface slopes towards the light, its own higher parts are nearer to the light
  // than the receiver, and no bound on depth rules blockers out. So the exits are for surfaces that face the light.
  void load(const std::string& name) {
    gpu_scene_.reset();
    const auto file = std::filesystem::path(PENUMBRA_ROOT) / "scenes" / (name + ".glb");
    scene_ = scene::read_gltf(file, image::image_decoder());
    setup_ = render::choose_setup(scene_, scene::pose_at(scene_, 0), {.aspect = static_cast<float>(width) / height});
    setup_.sun.to_light = glm::vec3(0, 1, 0);
    gpu_scene_.emplace(device_, scene_);
  }

  void draw(render::Renderer& renderer, const std::string& technique, float angle, bool early_exit) {
    ParamSet params(render::Renderer::params(renderer.registry()));
    renderer.registry().select(params, technique);
    params.set("sun.angle", angle);
    params.set("pcss.early_exit", early_exit);
    params.set("mask.tiles", false);  // tiles that are decided leave the exit nothing to do
    renderer.draw(*gpu_scene_,
                  {.width = width,
                   .height = height,
                   .camera = setup_.camera,
                   .last_camera = setup_.camera,
                   .lights = {setup_.sun},
                   .cut = true,
                   .mask_details = true},
                  params);
  }

  // All that a technique computes.
  std::vector<std::vector<float>> results(const std::string& technique, float angle, bool early_exit) {
    draw(renderer_, technique, angle, early_exit);
    return {renderer_.read_aov("shadow"), renderer_.read_aov("penumbra"), renderer_.read_aov("blocker"),
            renderer_.read_aov("under_texel")};
  }

  void expect_same_results(const std::string& technique, float angle) {
    SCOPED_TRACE(fmt::format("{}, {} degrees", technique, angle));
    const auto with = results(technique, angle, true);
    const auto without = results(technique, angle, false);
    expect_same_visibility(with[0], without[0], 16);
    if (gl::device_info().software) {
      EXPECT_EQ(with, without);
    }
    EXPECT_GT(std::ranges::count(with[0], 1.0f), 100) << "few pixels are lit";
    EXPECT_GT(std::ranges::count_if(with[0], [](float v) { return v < 1; }), 100) << "few pixels are in shadow";
  }

  // Receivers at which pcss returned early.
  std::ptrdiff_t exits(float angle, bool early_exit) {
    draw(exits_renderer_, "pcss", angle, early_exit);
    const std::vector<float> mask = exits_renderer_.read_aov("shadow"), depth = exits_renderer_.read_aov("depth");
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) count += mask[i] == 1 && depth[i] > 0 ? 1 : 0;
    return count;
  }

 private:
  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
  render::Renderer renderer_{device_}, exits_renderer_{device_, registry_of_exits()};
  scene::Scene scene_;
  render::Setup setup_;
  std::optional<scene::GpuScene> gpu_scene_;
};

TEST_F(EarlyExit, FiresAndChangesNoResult) {
  for (const char* scene : {"steps", "fence", "foliage", "coincident", "curtain", "courtyard"}) {
    SCOPED_TRACE(scene);
    load(scene);
    for (const float angle : {0.0f, 0.53f, 8.0f}) {
      expect_same_results("pcss", angle);
      EXPECT_GT(exits(angle, true), 100) << angle << " degrees";
    }
    EXPECT_EQ(exits(0.53f, false), 0);
  }
}

TEST_F(EarlyExit, ChangesNoResultInOtherDriversAndPresets) {
  for (const char* scene : {"fence", "coincident"}) {
    SCOPED_TRACE(scene);
    load(scene);
    for (const float angle : {0.53f, 8.0f}) {
      for (const char* preset : {"pcss_compute", "thesis_8x8"}) expect_same_results(preset, angle);
    }
  }
}

}  // namespace
}  // namespace penumbra::test

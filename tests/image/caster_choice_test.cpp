// Which faces and which surfaces cast: the shadow map and the rays of the truth have the same casters, whatever is
// chosen.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>

#include "gpu/gpu_test.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "scene/casting.h"
#include "truth/technique.h"

namespace penumbra::test {
namespace {

constexpr int width = 160, height = 120;

// A box about the origin whose triangles face outwards, or inwards.
scene::Primitive box(const glm::vec3& half, bool inwards) {
  scene::Primitive primitive;
  for (int side = 0; side < 6; ++side) {
    glm::vec3 normal(0), u(0), v(0);
    normal[side % 3] = side < 3 ? 1.0f : -1.0f;
    u[(side + 1) % 3] = 1;
    v[(side + 2) % 3] = side < 3 ? 1.0f : -1.0f;
    const auto first = static_cast<std::uint32_t>(primitive.positions.size());
    for (const glm::vec2& c : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
      primitive.positions.push_back((normal + c.x * u + c.y * v) * half);
      primitive.normals.push_back(inwards ? -normal : normal);
    }
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) primitive.indices.push_back(first + i);
  }
  if (inwards)
    for (std::size_t i = 0; i < primitive.indices.size(); i += 3)
      std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
  return primitive;
}

struct Means {
  double lit = 0;        // share of receivers that the shadow map has lit
  double different = 0;  // share of receivers at which the shadow map and rays disagree
};

// A crate on a floor, with an outline as an inverted hull, in a sky. The crate and its hull are mirrored.
class CasterChoiceImage : public GpuTest {
 protected:
  CasterChoiceImage() {
    add(box({8, 0.5f, 8}, false), glm::translate(glm::mat4(1), glm::vec3(0, -0.5f, 0)), "floor");
    const glm::mat4 mirror = glm::scale(glm::translate(glm::mat4(1), glm::vec3(0, 1, 0)), glm::vec3(-1, 1, 1));
    add(box({1, 1, 1}, false), mirror, "crate");
    add(box({1.2f, 1.2f, 1.2f}, true), mirror, "outline");
    add(box({60, 60, 60}, true), glm::mat4(1), "sky").sky = true;
  }

  scene::Node& add(scene::Primitive primitive, const glm::mat4& world, const std::string& name) {
    primitive.material = static_cast<int>(scene_.materials.size());
    scene_.materials.push_back({.name = name});
    scene::Node node{.name = name};
    node.matrix = world;
    node.mesh = static_cast<int>(scene_.meshes.size());
    scene_.meshes.push_back({.name = name, .primitives = {std::move(primitive)}});
    scene_.roots.push_back(static_cast<int>(scene_.nodes.size()));
    return scene_.nodes.emplace_back(std::move(node));
  }

  // As `casters.faces` and `casters.skies` have it.
  Means measure(const char* faces, bool skies = false) {
    scene::GpuScene gpu_scene(device_, scene_);
    ParamSet params(render::Renderer::params(renderer_.registry()));
    params.set_text("casters.faces", faces);
    params.set("casters.skies", skies);
    params.set("sun.angle", 0.5f);
    renderer_.registry().select(params, "hard");
    const std::vector<float> map = draw(gpu_scene, params, "shadow");
    const std::vector<float> normals = renderer_.read_aov("geometric_normal"), depth = renderer_.read_aov("depth");
    renderer_.registry().select(params, "truth");
    params.set("truth.samples", 8);
    draw(gpu_scene, params, "shadow");
    const std::vector<float>& rays = truth_.last().traced.hard;
    Means means;
    int count = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
      const glm::vec3 normal(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]);
      if (depth[i] == 0 || !(glm::dot(normal, to_light_) > 0.05f) || map[i] < 0) continue;
      ++count;
      means.lit += map[i];
      means.different += std::abs(map[i] - rays[(height - 1 - i / width) * width + i % width]) > 0.5f ? 1 : 0;
    }
    EXPECT_GT(count, width * height / 3);
    return {means.lit / count, means.different / count};
  }

  std::vector<float> draw(scene::GpuScene& gpu_scene, const ParamSet& params, const char* aov) {
    const render::Camera camera = render::look_at({4, 7, 6}, {0, 0.5f, 0}, 0.8f, 0.05f);
    renderer_.draw(gpu_scene,
                   {.width = width,
                    .height = height,
                    .camera = camera,
                    .last_camera = camera,
                    .lights = {render::SunLight{.to_light = to_light_}}},
                   params);
    return renderer_.read_aov(aov);
  }

  scene::Scene scene_;
  glm::vec3 to_light_ = glm::normalize(glm::vec3(0.4f, 1, 0.2f));
  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
  truth::TruthTechnique truth_{{.cache = {}}};
  render::Renderer renderer_{device_, truth_.registry()};
};

TEST_F(CasterChoiceImage, ByFaces) {
  const Means both = measure("both"), front = measure("front"), back = measure("back");
  EXPECT_LT(both.different, 0.02);
  EXPECT_LT(front.different, 0.02);
  EXPECT_LT(back.different, 0.02);
  EXPECT_GT(front.lit, both.lit + 0.01) << "the hull's shadow is smaller without its upper faces, and the crate is lit";
  EXPECT_LT(back.lit, front.lit);
}

TEST_F(CasterChoiceImage, SkiesOnlyIfAsked) {
  const Means usual = measure("both"), all = measure("both", /*skies=*/true), fronts = measure("front", true);
  EXPECT_GT(usual.lit, 0.5);
  EXPECT_LT(all.lit, 0.01) << "all is inside";
  EXPECT_LT(all.different, 0.02);
  EXPECT_GT(fronts.lit, 0.5) << "towards the sun it shows its back";
  EXPECT_LT(fronts.different, 0.02);
}

TEST_F(CasterChoiceImage, TheGroundOnlyIfALightIsNotAboveIt) {
  const Means with_floor = measure("both");
  scene_.nodes[0].ground = true;
  const Means usual = measure("both");
  EXPECT_NEAR(usual.lit, with_floor.lit, 0.005) << "it shadows nothing";
  EXPECT_LT(usual.different, 0.02);
  scene::GpuScene gpu_scene(device_, scene_);
  ParamSet drawn(render::Renderer::params(renderer_.registry()));
  for (const auto& [technique, width_of_casters] : {std::pair("hard", 3.0f), std::pair("vsm", 15.0f)}) {
    renderer_.registry().select(drawn, technique);
    draw(gpu_scene, drawn, "shadow");
    EXPECT_NEAR(gpu_scene.casters().extent().x, width_of_casters, 1) << technique;
  }
  ParamSet params(render::Renderer::params(renderer_.registry()));
  params.set("sun.angle", 2.0f);
  const auto ground_casts = [&](const std::vector<render::FrameLight>& lights) {
    return render::caster_choice(params, lights, renderer_.registry()).ground;
  };
  const auto sun_at = [](float degrees) {
    return render::SunLight{.to_light = render::direction_to(0, glm::radians(degrees))};
  };
  EXPECT_FALSE(ground_casts({sun_at(45)}));
  EXPECT_FALSE(ground_casts({sun_at(45), sun_at(1.1f)}));
  EXPECT_TRUE(ground_casts({sun_at(45), sun_at(0.9f)})) << "the horizon hides a part of the disc";
  EXPECT_TRUE(ground_casts({sun_at(45), render::LampLight{}}));
}

TEST_F(CasterChoiceImage, ByMaterialAndNode) {
  const Means both = measure("both");
  EXPECT_TRUE(scene::set_casting(scene_, "outline", scene::CastSetting::off));
  const Means without = measure("both");
  EXPECT_GT(without.lit, both.lit + 0.005);
  EXPECT_LT(without.different, 0.02);
  scene_.nodes[1].casting = scene::CastSetting::off;
  const Means nothing = measure("both");
  EXPECT_LT(without.lit, 1);
  EXPECT_EQ(nothing.lit, 1);
  EXPECT_LT(nothing.different, 0.02);
}

}  // namespace
}  // namespace penumbra::test

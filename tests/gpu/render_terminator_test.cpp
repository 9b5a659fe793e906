// Where light ends on smooth bodies of few triangles (render.soft_terminator).
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>

#include "render_scenes.h"

namespace penumbra::test {
namespace {

enum class Normals { smooth, flat };

// A ball of radius 1 with 12 rings of 24 segments, whose smooth normals lean by 10.6 degrees away from its triangles.
scene::Primitive ball(Normals normals) {
  constexpr int rings = 12, segments = 24;
  const auto on_ball = [](int ring, int segment) {
    const float down = glm::pi<float>() * static_cast<float>(ring) / rings;
    const float around = glm::two_pi<float>() * static_cast<float>(segment) / segments;
    return glm::vec3(std::sin(down) * std::cos(around), std::cos(down), -std::sin(down) * std::sin(around));
  };
  scene::Primitive ball;
  const auto add_triangle = [&](const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 across = glm::cross(b - a, c - a);
    if (glm::length(across) < 1e-4f) return;  // at the poles
    for (const glm::vec3& corner : {a, b, c}) {
      ball.indices.push_back(static_cast<std::uint32_t>(ball.positions.size()));
      ball.positions.push_back(corner);
      ball.normals.push_back(normals == Normals::smooth ? corner : glm::normalize(across));
    }
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int segment = 0; segment < segments; ++segment) {
      const glm::vec3 a = on_ball(ring, segment), b = on_ball(ring + 1, segment);
      const glm::vec3 c = on_ball(ring + 1, segment + 1), d = on_ball(ring, segment + 1);
      add_triangle(a, b, c);
      add_triangle(a, c, d);
    }
  }
  return ball;
}

class TerminatorTest : public RenderTest {
 protected:
  TerminatorTest() {
    params.set("render.sky_light", 0.0f);
    params.set("render.ground_light", 0.0f);
    params.set("exposure.auto", false);
    params.set("exposure.ev", -std::log2(1.2f));  // a luminance of 1 has the value 1 in the picture
    inputs.camera = inputs.last_camera = render::look_at({0, 0, 5}, {0, 0, 0}, 0.5f, 0.01f);
    sun() = {.to_light = glm::normalize(glm::vec3(1, 0.4f, 0.1f)), .illuminance = glm::vec3(3)};
  }

  std::vector<float> color_of(const scene::Scene& scene, const char* technique, bool soft) {
    params.set_text("technique", technique);
    params.set("render.soft_terminator", soft);
    draw(scene);
    return renderer.read_aov("color");
  }

  // The brightest pixel of the triangles that the sun would not light if it sank by a degree.
  float brightest_at_the_edge(const scene::Scene& scene, bool soft) {
    const std::vector<float> color = color_of(scene, "none", soft), normals = renderer.read_aov("geometric_normal");
    float most = 0;
    for (std::size_t i = 0; i < color.size(); i += 3) {
      const glm::vec3 normal(normals[i], normals[i + 1], normals[i + 2]);
      if (normal == glm::vec3(0)) continue;  // the sky
      const float towards = glm::dot(normal, sun().to_light);
      if (towards < std::sin(glm::radians(1.0f))) most = std::max(most, color[i]);
    }
    return most;
  }
};

scene::Scene scene_of(scene::Primitive primitive) {
  scene::Scene scene;
  scene.materials.push_back({.base_color = glm::vec4(1), .metallic = 0, .roughness = 1});
  primitive.material = 0;
  add_node(scene, std::move(primitive), glm::mat4(1));
  return scene;
}

// Beside them are triangles that face away from the sun, and so are dark, though their smooth normals face it.
TEST_F(TerminatorTest, TrianglesOfASmoothBallAreDarkBeforeTheyTurnAway) {
  const scene::Scene scene = scene_of(ball(Normals::smooth));
  EXPECT_LE(brightest_at_the_edge(scene, /*soft=*/true), 0.02f);
  EXPECT_GE(brightest_at_the_edge(scene, /*soft=*/false), 0.1f);
}

TEST_F(TerminatorTest, ADeformedBallIsLitAsOneThatKeepsItsShape) {
  scene::Primitive primitive = ball(Normals::smooth);
  const std::vector<float> rigid = color_of(scene_of(primitive), "none", /*soft=*/true);
  primitive.targets.push_back({.positions = std::vector<glm::vec3>(primitive.positions.size(), glm::vec3(0))});
  scene::Scene deforming = scene_of(primitive);
  deforming.meshes[0].default_weights = {1};
  const std::vector<float> deformed = color_of(deforming, "none", /*soft=*/true);
  for (std::size_t i = 0; i < rigid.size(); ++i) ASSERT_NEAR(rigid[i], deformed[i], 0.005f) << i;
}

TEST_F(TerminatorTest, FlatSurfacesLeavesAndWhatFacesTheLightStayAsTheyAre) {
  const scene::Scene flat = scene_of(ball(Normals::flat));
  EXPECT_EQ(color_of(flat, "none", true), color_of(flat, "none", false));
  scene::Scene leaves = scene_of(ball(Normals::smooth));
  leaves.materials[0].alpha_mode = scene::AlphaMode::mask;
  EXPECT_EQ(color_of(leaves, "none", true), color_of(leaves, "none", false));
  const scene::Scene smooth = scene_of(ball(Normals::smooth));
  const std::vector<float> soft = color_of(smooth, "none", true), usual = color_of(smooth, "none", false);
  ASSERT_NE(soft, usual);
  int bright = 0;
  for (std::size_t i = 0; i < usual.size(); ++i) {
    // Light comes in at more than one and a half times the lean, as a cosine; straight down it gives 3 / pi.
    if (usual[i] < 1.1f * 1.5f * 0.184f * 3 * glm::one_over_pi<float>()) continue;
    ++bright;
    ASSERT_EQ(soft[i], usual[i]) << i;
  }
  EXPECT_GT(bright, 100);
}

}  // namespace
}  // namespace penumbra::test

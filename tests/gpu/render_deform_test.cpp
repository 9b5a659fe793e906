// Skinning and morphing on the GPU, compared with the same computation on the CPU.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>

#include "render_scenes.h"
#include "support/temp_folder.h"

namespace penumbra::test {
namespace {

constexpr int vertices = 200;

// A strip of random triangles with two targets and three joints, animated. `seed`: other vertices.
scene::Scene deforming_scene(bool skinned, bool morphed, unsigned seed = 7, int count = vertices) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(-1, 1);
  const auto vector = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
  scene::Primitive primitive;
  for (int i = 0; i < count; ++i) {
    primitive.positions.push_back(vector());
    primitive.normals.push_back(glm::normalize(vector()));
    primitive.indices.push_back(static_cast<std::uint32_t>(i));
    if (!skinned) continue;
    primitive.joints.emplace_back(i % 3, (i + 1) % 3, (i + 2) % 3, 0);
    const float share = 0.5f + 0.5f * unit(random);
    primitive.weights.emplace_back(share, (1 - share) * 0.75f, (1 - share) * 0.25f, 0);
  }
  primitive.indices.resize(static_cast<std::size_t>(count) / 3 * 3);
  if (morphed) {
    primitive.targets.resize(2);
    for (int i = 0; i < count; ++i) {
      primitive.targets[0].positions.push_back(vector());
      primitive.targets[1].positions.push_back(vector());
    }
  }
  scene::Scene scene;
  scene::Node& node = add_node(scene, primitive, glm::translate(glm::mat4(1), glm::vec3(0.3f, 0.2f, 0.1f)));
  if (morphed) {
    scene.meshes[0].default_weights = {0, 0};
    scene.animations.push_back({.name = "morph",
                                .channels = {{.node = 0,
                                              .path = scene::Path::weights,
                                              .times = {0, 1},
                                              .values = {0.25f, 0, -0.5f, 1},
                                              .components = 2}},
                                .duration = 1});
  }
  if (skinned) {
    node.skin = 0;
    scene.skins.push_back({.name = "skin"});
    for (int j = 0; j < 3; ++j) {
      const int joint = static_cast<int>(scene.nodes.size());
      scene.skins[0].joints.push_back(joint);
      scene.skins[0].inverse_bind.push_back(glm::translate(glm::mat4(1), vector()));
      scene.roots.push_back(joint);
      scene.nodes.push_back({.name = "joint", .transform = {.translation = vector(), .scale = glm::vec3(1, 2, 0.5f)}});
      scene.animations.push_back(
          {.name = "bend",
           .channels = {{.node = joint, .times = {0, 1}, .values = {0, 0, 0, 1, static_cast<float>(j), -1}}},
           .duration = 1});
    }
  }
  return scene;
}

std::vector<glm::vec3> deformed_on_cpu(const scene::Primitive& primitive, std::size_t node, const scene::Pose& pose) {
  std::vector<glm::vec3> result = primitive.positions;
  for (std::size_t i = 0; i < result.size(); ++i) {
    for (std::size_t t = 0; t < primitive.targets.size(); ++t) {
      result[i] += pose.weights[node][t] * primitive.targets[t].positions[i];
    }
    if (primitive.joints.empty()) continue;
    glm::vec3 sum(0);
    for (int k = 0; k < 4; ++k) {
      sum += primitive.weights[i][k] * glm::vec3(pose.skin[node][primitive.joints[i][k]] * glm::vec4(result[i], 1));
    }
    result[i] = sum;
  }
  return result;
}

std::vector<glm::vec3> deformed_on_cpu(const scene::Scene& scene, const scene::Pose& pose) {
  return deformed_on_cpu(scene.meshes[0].primitives[0], 0, pose);
}

class DeformTest : public RenderTest {};

TEST_F(DeformTest, PositionsEqualTheSumsOnTheCpu) {
  for (const auto& [skinned, morphed] : {std::pair(true, false), std::pair(false, true), std::pair(true, true)}) {
    const scene::Scene scene = deforming_scene(skinned, morphed);
    scene::GpuScene on_gpu(device, scene);
    for (const double time : {0.0, 0.4, 0.9, 0.4}) {
      on_gpu.pose(device, time, time);
      const std::vector<glm::vec3> gpu = on_gpu.read_deformed();
      const std::vector<glm::vec3> cpu = deformed_on_cpu(scene, scene::pose_at(scene, time));
      ASSERT_EQ(gpu.size(), cpu.size());
      for (std::size_t i = 0; i < cpu.size(); ++i)
        ASSERT_LT(glm::distance(gpu[i], cpu[i]), 1e-5f) << i << " at " << time;
    }
  }
}

// More than one row of invocations: see glsl/scene/rows_of_work.glsl.
TEST_F(DeformTest, LargePrimitivesAreComputedToTheirEnd) {
  const scene::Scene scene = deforming_scene(false, true, 7, 200'003);
  scene::GpuScene on_gpu(device, scene);
  on_gpu.pose(device, 0.4, 0.4);
  const std::vector<glm::vec3> gpu = on_gpu.read_deformed();
  const std::vector<glm::vec3> cpu = deformed_on_cpu(scene, scene::pose_at(scene, 0.4));
  ASSERT_EQ(gpu.size(), cpu.size());
  for (std::size_t i = 0; i < cpu.size(); ++i) ASSERT_LT(glm::distance(gpu[i], cpu[i]), 1e-5f) << i;
}

TEST_F(DeformTest, EachOfTwoPrimitivesKeepsItsOwnVertices) {
  scene::Scene first = deforming_scene(false, true), second = deforming_scene(false, true, 8);
  const std::vector<glm::vec3> of_first = deformed_on_cpu(first, scene::pose_at(first, 0.4));
  const std::vector<glm::vec3> of_second = deformed_on_cpu(second, scene::pose_at(second, 0.4));
  scene::Scene both = first;
  add_node(both, second.meshes[0].primitives[0], glm::mat4(1));
  both.meshes[1].default_weights = {0, 0};
  both.animations.push_back(second.animations[0]);
  both.animations[1].channels[0].node = 1;
  scene::GpuScene on_gpu(device, both);
  on_gpu.pose(device, 0.4, 0.4);
  const std::vector<glm::vec3> gpu = on_gpu.read_deformed();
  ASSERT_EQ(gpu.size(), of_first.size() + of_second.size());
  for (std::size_t i = 0; i < of_first.size(); ++i) {
    ASSERT_LT(glm::distance(gpu[i], of_first[i]), 1e-5f) << i;
    ASSERT_LT(glm::distance(gpu[of_first.size() + i], of_second[i]), 1e-5f) << i;
  }
}

// Two primitives of a node, and of another one whose skin has more joints.
TEST_F(DeformTest, PrimitivesOfANodeShareItsJointsAndWeights) {
  scene::Scene scene = deforming_scene(true, true);
  scene.meshes[0].primitives.push_back(deforming_scene(true, true, 8).meshes[0].primitives[0]);
  const int other = static_cast<int>(scene.nodes.size());
  scene.nodes.push_back(scene.nodes[0]);
  scene.nodes.back().skin = 1;
  scene.nodes.back().weights = {0.5f, -1};
  scene.roots.push_back(other);
  scene::Skin skin = scene.skins[0];
  std::ranges::reverse(skin.joints);
  skin.joints.push_back(0);
  skin.inverse_bind.emplace_back(1);
  scene.skins.push_back(skin);
  scene::GpuScene on_gpu(device, scene);
  on_gpu.pose(device, 0.4, 0.4);
  const scene::Pose pose = scene::pose_at(scene, 0.4);
  std::vector<glm::vec3> cpu;
  for (const int node : {0, other})
    for (const scene::Primitive& primitive : scene.meshes[0].primitives)
      for (const glm::vec3& position : deformed_on_cpu(primitive, static_cast<std::size_t>(node), pose))
        cpu.push_back(position);
  const std::vector<glm::vec3> gpu = on_gpu.read_deformed();
  ASSERT_EQ(gpu.size(), cpu.size());
  for (std::size_t i = 0; i < cpu.size(); ++i) ASSERT_LT(glm::distance(gpu[i], cpu[i]), 1e-5f) << i;
  EXPECT_LT(device.scratch("joint matrices", 0).size(), (3 + 4 + 1) * sizeof(glm::mat4));
}

TEST_F(DeformTest, BoxesHoldEveryVertex) {
  const scene::Scene scene = deforming_scene(true, true);
  scene::GpuScene on_gpu(device, scene);
  for (const double time : {0.0, 0.3, 0.8}) {
    on_gpu.pose(device, time, time);
    const scene::Bounds box = on_gpu.casters(), exact = scene::bounds_of(scene, scene::pose_at(scene, time));
    for (int i = 0; i < 3; ++i) {
      EXPECT_LE(box.min[i], exact.min[i] + 1e-4f);
      EXPECT_GE(box.max[i], exact.max[i] - 1e-4f);
    }
  }
}

TEST_F(DeformTest, AChangedShaderPosesTheSameTimeAgain) {
  const TempFolder folder;
  gl::Device changing{gl::ShaderFiles(folder.path().string()), gl::Timers::Mode::off};
  const scene::Scene scene = deforming_scene(true, true);
  scene::GpuScene on_gpu(changing, scene);
  on_gpu.pose(changing, 0.4, 0.4);
  const std::vector<glm::vec3> before = on_gpu.read_deformed();

  std::string text = gl::ShaderFiles().read("scene/deform.comp").value();
  const std::string line = "= position.x;";
  text.replace(text.find(line), line.size(), "= position.x + 1.0;");
  std::filesystem::create_directory(folder.path() / "scene");
  std::ofstream(folder.path() / "scene/deform.comp") << text;
  changing.shaders.changed("scene/deform.comp");
  on_gpu.pose(changing, 0.4, 0.4);
  const std::vector<glm::vec3> after = on_gpu.read_deformed();
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) ASSERT_FLOAT_EQ(after[i].x, before[i].x + 1) << i;
}

TEST_F(DeformTest, MotionFollowsTheMorph) {
  scene::Primitive quad = square();
  quad.targets.resize(1);
  quad.targets[0].positions.assign(4, {1, 0, 0});
  scene::Scene scene;
  add_node(scene, quad, glm::mat4(1));
  scene.meshes[0].default_weights = {0};
  scene.animations.push_back(
      {.name = "slide",
       .channels = {{.node = 0, .path = scene::Path::weights, .times = {0, 1}, .values = {0, 1}, .components = 1}},
       .duration = 1});
  // Whatever the order of the two poses, and after a jump in time.
  for (const auto& [last, now] : {std::pair(0.25, 0.5), std::pair(0.5, 0.25), std::pair(0.75, 0.5)}) {
    inputs.last_time = last;
    inputs.time = now;
    if (!gpu_scene) gpu_scene.emplace(device, scene);
    renderer.draw(*gpu_scene, inputs, params);
    const auto expected = static_cast<float>((now - last) / (4.0 * std::tan(0.5)) * height / 2);
    EXPECT_NEAR(pixel("motion", width / 2 + 3, height / 2)[0], expected, 1e-3f) << last << " to " << now;
  }
}

TEST_F(DeformTest, GeometricNormalsFollowTheMorph) {
  // The upper edge of two squares, of which the second is mirrored, comes forward by their side.
  scene::Primitive quad = square();
  quad.targets.resize(1);
  quad.targets[0].positions = {{0, 0, 0}, {0, 0, 0}, {0, 0, 2}, {0, 0, 2}};
  scene::Scene scene;
  add_node(scene, square(), glm::translate(glm::mat4(1), glm::vec3(0, 0, -20)));  // of which no triangle is looked up
  for (const float side : {-1.0f, 1.0f}) {
    const glm::mat4 world = glm::translate(glm::mat4(1), glm::vec3(side, 0, 0));
    add_node(scene, quad, glm::scale(world, glm::vec3(-side, 1, 1)));
    scene.meshes.back().default_weights = {0};
    const int node = static_cast<int>(scene.nodes.size()) - 1;
    scene.animations.push_back(
        {.name = "tilt",
         .channels =
             {{.node = node, .path = scene::Path::weights, .times = {0, 1}, .values = {0, side}, .components = 1}},
         .duration = 1});
  }
  gpu_scene.emplace(device, scene);
  for (const float tilt : {0.0f, 1.0f, 0.25f}) {
    inputs.last_time = inputs.time = tilt;
    renderer.draw(*gpu_scene, inputs, params);
    for (const int side : {-1, 1}) {
      const glm::vec3 expected = glm::normalize(glm::vec3(0, -static_cast<float>(side) * tilt, 1));
      const glm::vec3 seen = pixel3("geometric_normal", width / 2 + side * 6, height / 2);
      EXPECT_LT(glm::distance(seen, expected), 1e-6f) << side << " at " << tilt;
    }
  }
}

// A tilted square's normals, which lean to the side by a morph, under a joint that stretches and flattens it.
TEST_F(DeformTest, NormalsFollowTheMorphAndTheJoints) {
  const glm::mat3 tilt = glm::mat3_cast(glm::angleAxis(-0.7f, glm::vec3(1, 0, 0)));
  const glm::vec3 stretch(1, 2, 0.5f), lean(0.8f, 0, 0);
  scene::Primitive quad = square();
  for (glm::vec3& position : quad.positions) position = tilt * position;
  quad.normals.assign(4, tilt[2]);
  quad.joints.assign(4, {0, 0, 0, 0});
  quad.weights.assign(4, {1, 0, 0, 0});
  quad.targets.resize(1);
  quad.targets[0].normals.assign(4, lean);
  scene::Scene scene;
  add_node(scene, quad, glm::mat4(1)).skin = 0;
  scene.meshes[0].default_weights = {0.5f};
  scene.skins.push_back({.name = "skin", .joints = {1}, .inverse_bind = {glm::mat4(1)}});
  scene.nodes.push_back({.name = "joint", .transform = {.scale = stretch}});
  scene.roots.push_back(1);
  draw(scene);
  const glm::vec3 expected = glm::normalize((tilt[2] + 0.5f * lean) / stretch);
  EXPECT_LT(glm::distance(pixel3("normal", width / 2 + 3, height / 2), expected), 1e-3f);
}

TEST_F(DeformTest, TangentsFollowTheMorph) {
  auto [scene, quad] = leaning_square();
  quad.targets.resize(1);
  quad.targets[0].tangents.assign(4, {-2, 2, 0});
  add_node(scene, quad, glm::mat4(1));
  scene.meshes[0].default_weights = {0.5f};
  draw(scene);
  const glm::vec3 normal = pixel3("normal", width / 2 + 3, height / 2);
  EXPECT_LT(glm::distance(normal, glm::vec3(0, 0.6f, 0.8f)), 0.01f);
}

// A quarter turn of a normal map's square, by its node or by a joint.
TEST_F(DeformTest, TangentsFollowTheJoints) {
  auto [scene, quad] = leaning_square();
  const scene::Transform quarter{.rotation = glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 0, 1))};
  add_node(scene, quad, glm::mat4_cast(quarter.rotation));
  draw(scene);
  const glm::vec3 by_node = pixel3("normal", width / 2 + 3, height / 2);
  EXPECT_NEAR(by_node.y, 0.6f, 0.01f);

  quad.joints.assign(4, {0, 0, 0, 0});
  quad.weights.assign(4, {1, 0, 0, 0});
  scene.meshes[0].primitives = {quad};
  scene.nodes[0].matrix.reset();
  scene.nodes[0].skin = 0;
  scene.skins.push_back({.name = "skin", .joints = {1}, .inverse_bind = {glm::mat4(1)}});
  scene.nodes.push_back({.name = "joint", .transform = quarter});
  scene.roots.push_back(1);
  draw(scene);
  EXPECT_LT(glm::distance(pixel3("normal", width / 2 + 3, height / 2), by_node), 1e-3f);
}

}  // namespace
}  // namespace penumbra::test

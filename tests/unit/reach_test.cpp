// How far a scene reaches from the origin, and the bound of it for frames.

#include "scene/reach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace penumbra::test {
namespace {

using scene::Pose;
using scene::ReachBound;
using scene::Scene;

Scene triangle(scene::Node node) {
  scene::Primitive primitive{.indices = {0, 1, 2}, .positions = {{0, 0, 0}, {2, 0, 0}, {0, -3, 0}}};
  Scene scene;
  scene.meshes.push_back({.name = "", .primitives = {std::move(primitive)}, .default_weights = {}});
  node.mesh = 0;
  scene.nodes.push_back(std::move(node));
  scene.roots = {0};
  return scene;
}

void expect_reach(const Scene& scene, double reach) {
  const Pose pose = scene::rest_pose(scene);
  EXPECT_NEAR(scene::reach_of(scene, pose), reach, 1e-4 * reach);
  EXPECT_GE(ReachBound(scene).at(pose), scene::reach_of(scene, pose));
}

TEST(Reach, IsThatOfWhatIsDrawn) {
  expect_reach(triangle({}), 3);
  expect_reach(triangle({.transform = {.translation = {0, -10, 0}, .scale = {1, 2, 1}}}), 16);
  const float half = std::sqrt(0.5f);  // a quarter of a turn about z
  expect_reach(triangle({.transform = {.rotation = {half, 0, 0, half}, .scale = {1, 4, 1}}}), 12);
}

TEST(Reach, CountsInstances) {
  scene::Node node;
  node.transform.translation = {5, 0, 0};
  node.instances = {{.translation = {-1, 0, 0}}, {.translation = {0, 20, 0}, .scale = {10, 10, 10}}};
  expect_reach(triangle(node), 25);
}

TEST(Reach, CountsMorphTargets) {
  Scene scene = triangle({.weights = {-2}});
  scene.meshes[0].primitives[0].targets = {
      {.positions = {{0, 0, 0}, {0, 0, 50}, {0, 0, 0}}, .normals = {}, .tangents = {}}};
  scene.meshes[0].default_weights = {0};
  expect_reach(scene, 100);
}

TEST(Reach, CountsJoints) {
  Scene scene = triangle({.skin = 0});
  scene.nodes.push_back({.transform = {.translation = {0, 0, 7}, .scale = {100, 100, 100}}});
  scene.skins.push_back({.name = "", .joints = {1}, .inverse_bind = {glm::mat4(1)}});
  scene.meshes[0].primitives[0].joints.assign(3, glm::u16vec4(0));
  scene.meshes[0].primitives[0].weights.assign(3, glm::vec4(1, 0, 0, 0));
  expect_reach(scene, 300);
}

TEST(Reach, CountsNodesThatDrawNothing) {
  Scene scene = triangle({});
  scene.nodes.push_back({.transform = {.translation = {0, 1e30f, 0}}});
  expect_reach(scene, 1e30);
  EXPECT_EQ(scene::over_extent(1e37, 1e9), "reaches 1e+37 m from the origin, over the limit of 1e+09 m");
}

TEST(Reach, IsInfiniteOutsideOfFloatsRange) {
  const Scene scene = triangle({.transform = {.scale = {3e38f, 1, 1}}});
  const Pose pose = scene::rest_pose(scene);
  EXPECT_TRUE(std::isinf(scene::reach_of(scene, pose)));
  EXPECT_GT(ReachBound(scene).at(pose), 3e38);
}

}  // namespace
}  // namespace penumbra::test

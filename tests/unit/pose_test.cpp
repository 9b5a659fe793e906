// Animation, hierarchy, skins and bounds against closed forms.

#include "scene/pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>

#include "scene/animation.h"

namespace penumbra::test {
namespace {

using scene::Animation;
using scene::AnimationChannel;
using scene::Bounds;
using scene::bounds_of;
using scene::Interpolation;
using scene::jumps_between;
using scene::looped_time;
using scene::Path;
using scene::played_animations;
using scene::Pose;
using scene::pose_at;
using scene::rest_pose;
using scene::sample;
using scene::Scene;
using scene::to_matrix;
using scene::to_transform;
using scene::Topology;
using scene::Transform;

AnimationChannel channel(Path path, Interpolation interpolation, std::vector<float> times, std::vector<float> values,
                         int components = 3) {
  return {.node = 0,
          .path = path,
          .interpolation = interpolation,
          .times = std::move(times),
          .values = std::move(values),
          .components = components};
}

Scene scene_with(std::vector<Animation> animations) {
  Scene scene;
  scene.nodes.resize(1);
  scene.roots = {0};
  scene.animations = std::move(animations);
  for (Animation& animation : scene.animations)
    for (const AnimationChannel& c : animation.channels)
      animation.duration = std::max(animation.duration, c.times.back());
  return scene;
}

glm::vec3 position_at(const Scene& scene, double seconds) { return {pose_at(scene, seconds).world[0][3]}; }

TEST(Animation, StepHoldsTheLastKey) {
  const auto step = channel(Path::translation, Interpolation::step, {0, 1}, {0, 0, 0, 5, 0, 0});
  EXPECT_EQ(sample(step, 0.999)[0], 0);
  EXPECT_EQ(sample(step, 1)[0], 5);
}

TEST(Animation, HoldsBeforeTheFirstAndAfterTheLastKey) {
  for (const auto interpolation : {Interpolation::step, Interpolation::linear}) {
    const auto c = channel(Path::scale, interpolation, {1, 2}, {3, 3, 3, 7, 7, 7});
    EXPECT_EQ(sample(c, 0)[0], 3);
    EXPECT_EQ(sample(c, 100)[0], 7);
  }
}

TEST(Animation, LinearRotationTurnsAtConstantSpeed) {
  const float s = std::sqrt(0.5f);
  const auto c = channel(Path::rotation, Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, s, 0, s}, 4);
  for (const double t : {0.1, 0.25, 0.5, 0.9}) {
    const auto q = sample(c, t);
    EXPECT_NEAR(2 * std::atan2(q[1], q[3]), t * std::acos(0.0), 1e-5) << t;
  }
}

TEST(Animation, LinearRotationTakesTheShortWay) {
  const auto c = channel(Path::rotation, Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0, -0.1f, -1}, 4);
  EXPECT_GT(std::abs(sample(c, 0.5)[3]), 0.99f);
}

TEST(Animation, CubicSplineIsHermites) {
  // x(t) = t³ over [0, 2]: values 0 and 8, slopes 0 and 12.
  const auto c = channel(Path::translation, Interpolation::cubic_spline, {0, 2},
                         {9, 9, 9, 0, 0, 0, 0, 0, 0, /* key 2: */ 12, 12, 12, 8, 8, 8, 9, 9, 9});
  for (const double t : {0.0, 0.3, 1.0, 1.7, 2.0}) EXPECT_NEAR(sample(c, t)[1], t * t * t, 1e-5) << t;
}

TEST(Animation, WhatRestsDoesNotMoveByRounding) {
  const auto line = channel(Path::translation, Interpolation::linear, {0, 3}, {0.1f, -4.7f, 3.3f, 0.1f, -4.7f, 3.3f});
  const auto turn =
      channel(Path::rotation, Interpolation::linear, {0, 3}, {0.1f, 0.7f, -0.3f, 0.64f, 0.1f, 0.7f, -0.3f, 0.64f}, 4);
  const auto curve = channel(Path::translation, Interpolation::cubic_spline, {0, 3},
                             {0, 0, 0, 0.1f, -4.7f, 3.3f, 0, 0, 0, 0, 0, 0, 0.1f, -4.7f, 3.3f, 0, 0, 0});
  for (const auto& at_rest : {line, turn, curve}) {
    for (double time = 0; time < 3; time += 0.013) ASSERT_EQ(sample(at_rest, time), sample(at_rest, 0)) << time;
  }
}

TEST(Animation, LoopsOverItsOwnDuration) {
  EXPECT_DOUBLE_EQ(looped_time(0, 2), 0);
  EXPECT_DOUBLE_EQ(looped_time(2, 2), 2) << "its end is not its start";
  EXPECT_DOUBLE_EQ(looped_time(5, 2), 1);
  EXPECT_DOUBLE_EQ(looped_time(-0.5, 2), 1.5);
  EXPECT_DOUBLE_EQ(looped_time(7, 0), 0);
  EXPECT_DOUBLE_EQ(looped_time(std::numeric_limits<double>::infinity(), 2), 0);
}

TEST(Pose, PlaysAnimationsTogetherUnlessTheyDriveTheSame) {
  const auto move = [](float to) {
    return Animation{.channels = {channel(Path::translation, Interpolation::linear, {0, 1}, {0, 0, 0, to, 0, 0})}};
  };
  const Animation grow{.channels = {channel(Path::scale, Interpolation::linear, {0, 1}, {1, 1, 1, 3, 3, 3})}};
  const Scene scene = scene_with({move(1), move(100), grow});
  EXPECT_EQ(played_animations(scene), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(position_at(scene, 0.5), glm::vec3(0.5f, 0, 0));
  EXPECT_FLOAT_EQ(pose_at(scene, 0.5).world[0][0][0], 2);
}

TEST(Animation, JumpsWhereALoopBeginsAgainFromOtherValues) {
  const Animation away{.channels = {channel(Path::translation, Interpolation::linear, {0, 0.3f}, {0, 0, 0, 1, 0, 0})}};
  const double end = 0.3f;
  const Scene scene = scene_with({away});
  EXPECT_FALSE(jumps_between(scene, 0, 0));
  EXPECT_FALSE(jumps_between(scene, 0, end)) << "the last key holds at the end";
  EXPECT_TRUE(jumps_between(scene, end, 0.31));
  EXPECT_TRUE(jumps_between(scene, 0.31, 0.29)) << "backwards";
  EXPECT_TRUE(jumps_between(scene, 0.1, 0.5)) << "a step that is longer than a loop";
  int jumps = 0;
  for (int frame = 1; frame <= 240; ++frame) jumps += jumps_between(scene, (frame - 1) / 24.0, frame / 24.0) ? 1 : 0;
  EXPECT_EQ(jumps, 33) << "once a loop in 10 s";
}

// A last key at the time of the one before it, which takes everything back to the beginning.
TEST(Animation, JumpsWhereOnlyItsVeryLastKeyClosesALoop) {
  const auto with_last = [](Interpolation interpolation, float before_it) {
    return scene_with({{.channels = {channel(Path::translation, interpolation, {0, 1, 2, 2},
                                             {5, 0, 0, 9, 0, 0, before_it, 0, 0, 5, 0, 0})}}});
  };
  EXPECT_TRUE(jumps_between(with_last(Interpolation::linear, 8), 1.9, 2.1));
  EXPECT_FALSE(jumps_between(with_last(Interpolation::linear, 5), 1.9, 2.1));
  EXPECT_FALSE(jumps_between(with_last(Interpolation::step, 8), 1.9, 2.1)) << "steps come to no key before it is there";
  Scene longer = with_last(Interpolation::linear, 8);
  longer.animations[0].channels.push_back(channel(Path::scale, Interpolation::linear, {0, 3}, {1, 1, 1, 1, 1, 1}));
  longer.animations[0].duration = 3;
  EXPECT_FALSE(jumps_between(longer, 2.9, 3.1)) << "until the end, the very last key holds";
}

TEST(Animation, JumpsWhereALoopEndsTurnedAway) {
  const Animation quarter{
      .channels = {channel(Path::rotation, Interpolation::linear, {0, 1}, {0, 0, 0, 1, 0, 0.6f, 0, 0.8f}, 4)}};
  EXPECT_TRUE(jumps_between(scene_with({quarter}), 0.9, 1.1));
}

TEST(Animation, DoesNotJumpWhereALoopEndsAsItBegan) {
  const Animation there_and_back{
      .channels = {channel(Path::translation, Interpolation::linear, {0, 1, 2}, {5, 0, 0, 9, 0, 0, 5.00001f, 0, 0})}};
  // A full turn: the last quaternion is the negative of the first, which is the same rotation.
  const Animation turn{.channels = {channel(Path::rotation, Interpolation::linear, {0, 1, 2},
                                            {0, 0, 0, 1, 0, 1, 0, 0, 0, 0, 0, -1}, 4)}};
  const Animation still{.channels = {channel(Path::scale, Interpolation::step, {0}, {1, 1, 1})}};
  EXPECT_FALSE(jumps_between(scene_with({there_and_back, turn, still}), 1.9, 2.1));
  EXPECT_FALSE(jumps_between(scene_with({}), 0, 5));
}

TEST(Pose, RestsWithoutAnimation) {
  Scene scene = scene_with({});
  scene.nodes[0].transform.translation = {1, 2, 3};
  EXPECT_EQ(position_at(scene, 12), glm::vec3(1, 2, 3));
  EXPECT_EQ(rest_pose(scene).world[0], pose_at(scene, 0).world[0]);
}

TEST(Pose, ComposesTranslationRotationScaleDownTheHierarchy) {
  Scene scene;
  scene.nodes.resize(3);
  scene.nodes[2].children = {0};  // a parent may follow its child in the file
  scene.nodes[0].parent = 2;
  scene.nodes[2].transform = {.translation = {10, 0, 0},
                              .rotation = glm::angleAxis(glm::radians(90.0f), glm::vec3(0, 0, 1)),
                              .scale = glm::vec3(2)};
  scene.nodes[0].transform.translation = {1, 0, 0};
  scene.roots = {2};
  const Pose pose = pose_at(scene, 0);
  EXPECT_NEAR(glm::distance(glm::vec3(pose.world[0][3]), glm::vec3(10, 2, 0)), 0, 1e-5);
  EXPECT_EQ(pose.drawn, (std::vector<bool>{true, false, true}));
}

TEST(Pose, SurvivesDeepHierarchiesAndDegenerateScales) {
  Scene scene;
  scene.nodes.resize(100'000);
  for (std::size_t i = 1; i < scene.nodes.size(); ++i) {
    scene.nodes[i].parent = static_cast<int>(i) - 1;
    scene.nodes[i - 1].children = {static_cast<int>(i)};
    scene.nodes[i].transform.scale = glm::vec3(i % 2 == 0 ? 0.0f : 1e30f);
  }
  scene.roots = {0};
  for (const glm::mat4& world : pose_at(scene, 0).world)
    for (glm::length_t c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(world[c][c]));
}

TEST(Pose, SkinsByJointsAloneNotByTheMeshsNode) {
  Scene scene;
  scene.nodes.resize(2);
  scene.nodes[0].transform.translation = {100, 0, 0};  // ignored for a skinned mesh
  scene.nodes[0].mesh = scene.nodes[0].skin = 0;
  scene.nodes[1].transform.translation = {0, 5, 0};
  scene.skins = {{.joints = {1}, .inverse_bind = {glm::translate(glm::mat4(1), glm::vec3(0, -1, 0))}}};
  scene.meshes = {{.primitives = {{.indices = {0, 0, 0},
                                   .positions = {{1, 1, 1}},
                                   .normals = {{0, 1, 0}},
                                   .joints = {{0, 0, 0, 0}},
                                   .weights = {{1, 0, 0, 0}}}}}};
  scene.roots = {0, 1};
  const Pose pose = pose_at(scene, 0);
  EXPECT_EQ(glm::vec3(pose.skin[0][0][3]), glm::vec3(0, 4, 0));
  EXPECT_EQ(bounds_of(scene, pose).min, glm::vec3(1, 5, 1));
}

Scene triangle_scene() {
  Scene scene = scene_with({});
  scene.meshes = {{.primitives = {{.indices = {0, 1, 2},
                                   .positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                   .normals = std::vector<glm::vec3>(3, {0, 0, 1})}}}};
  scene.nodes[0].mesh = 0;
  return scene;
}

TEST(Bounds, FollowMorphTargets) {
  Scene scene = triangle_scene();
  scene.meshes[0].primitives[0].targets = {{.positions = {{0, 0, 0}, {4, 0, 0}, {0, 0, 0}}}};
  scene.meshes[0].default_weights = {0.5f};
  EXPECT_EQ(bounds_of(scene, pose_at(scene, 0)).max, glm::vec3(3, 1, 0));
  scene.nodes[0].weights = {1};
  EXPECT_EQ(bounds_of(scene, pose_at(scene, 0)).max, glm::vec3(5, 1, 0)) << "a node's weights override its mesh's";
}

TEST(Bounds, LeaveOutWhatIsNotDrawnAndPointsBesideTriangles) {
  Scene scene = triangle_scene();
  scene.meshes.push_back(
      {.primitives = {
           {.topology = Topology::points, .indices = {0}, .positions = {{9, 9, 9}}, .normals = {{0, 1, 0}}}}});
  scene.nodes.resize(3);
  scene.nodes[1].mesh = 1;
  scene.nodes[2].mesh = 0;
  scene.nodes[2].transform.translation = {50, 0, 0};
  scene.roots = {0, 1};
  EXPECT_EQ(bounds_of(scene, pose_at(scene, 0)).max, glm::vec3(1, 1, 0));
  scene.roots = {1};
  EXPECT_EQ(bounds_of(scene, pose_at(scene, 0)).max, glm::vec3(9, 9, 9)) << "points count where there is nothing else";
  scene.roots = {};
  EXPECT_TRUE(bounds_of(scene, pose_at(scene, 0)).empty);
}

TEST(Bounds, HoldEveryInstanceWhenBoxesStandIn) {
  Scene scene = triangle_scene();
  scene.nodes[0].instances.resize(1'000'000);  // three million vertices, beyond the exact count
  scene.nodes[0].instances.back().translation = {7, 8, 9};
  const Bounds bounds = bounds_of(scene, pose_at(scene, 0));
  EXPECT_EQ(bounds.min, glm::vec3(0));
  EXPECT_EQ(bounds.max, glm::vec3(8, 9, 9));
}

TEST(Bounds, HoldMorphsOfEitherSignWhenBoxesStandIn) {
  Scene scene = triangle_scene();
  scene.nodes[0].instances.resize(1'000'000);  // three million vertices, beyond the exact count
  scene.meshes[0].primitives[0].targets = {{.positions = {{-1, 0, 0}, {3, 0, 0}, {0, 2, 0}}}};
  for (const float weight : {1.0f, -1.0f}) {
    scene.meshes[0].default_weights = {weight};
    const Bounds bounds = bounds_of(scene, pose_at(scene, 0));
    EXPECT_EQ(bounds.min, weight > 0 ? glm::vec3(-1, 0, 0) : glm::vec3(-3, -2, 0));
    EXPECT_EQ(bounds.max, weight > 0 ? glm::vec3(4, 3, 0) : glm::vec3(2, 1, 0));
  }
}

TEST(Transform, SurvivesTheWayThroughAMatrix) {
  const Transform transform{.translation = {1, -2, 3},
                            .rotation = glm::normalize(glm::quat(0.5f, 0.1f, -0.7f, 0.2f)),
                            .scale = {-2, 0.5f, 3}};
  const glm::mat4 matrix = to_matrix(transform), again = to_matrix(to_transform(matrix));
  for (glm::length_t c = 0; c < 4; ++c)
    for (glm::length_t r = 0; r < 4; ++r) EXPECT_NEAR(matrix[c][r], again[c][r], 1e-5);
}

}  // namespace
}  // namespace penumbra::test

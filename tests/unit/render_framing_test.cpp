// "Frame casters" shows what casts shadows, without the ground below it.
#include "render/framing.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace penumbra {
namespace {

using scene::Bounds;
using scene::Scene;

// Adds a box as a node of its own.
scene::Node& add(Scene& scene, const glm::vec3& min, const glm::vec3& max) {
  scene::Primitive primitive;
  primitive.positions = {min, max, {min.x, max.y, min.z}};
  primitive.indices = {0, 1, 2};
  scene.meshes.push_back({.name = "", .primitives = {primitive}, .default_weights = {}});
  scene::Node node;
  node.mesh = static_cast<int>(scene.meshes.size()) - 1;
  scene.roots.push_back(static_cast<int>(scene.nodes.size()));
  scene.nodes.push_back(node);
  return scene.nodes.back();
}

void expect_framed(const Scene& scene, const glm::vec3& min, const glm::vec3& max,
                   const scene::CasterChoice& choice = {}) {
  const Bounds framed = render::caster_bounds(scene, scene::rest_pose(scene), choice);
  EXPECT_FALSE(framed.empty);
  EXPECT_EQ(framed.min, min);
  EXPECT_EQ(framed.max, max);
}

TEST(RenderFraming, TheGroundIsLeftOut) {
  Scene scene;
  add(scene, {-50, 0, -50}, {50, 0, 50});
  add(scene, {-1, 0, -1}, {1, 2, 1});
  add(scene, {3, 0, -1}, {4, 3, 1});
  expect_framed(scene, {-1, 0, -1}, {4, 3, 1});
}

TEST(RenderFraming, SoIsTheGroundBelowAThinCaster) {
  Scene scene;
  add(scene, {-50, -0.1f, -50}, {50, 0, 50});
  add(scene, {-1, 2, -1}, {1, 2.01f, 1});
  expect_framed(scene, {-1, 2, -1}, {1, 2.01f, 1});
}

TEST(RenderFraming, ARoofAndAFloorWithinWallsStay) {
  Scene scene;
  add(scene, {-50, 3, -50}, {50, 3, 50});
  add(scene, {-1, 0, -1}, {1, 3, 1});
  expect_framed(scene, {-50, 0, -50}, {50, 3, 50});
  add(scene, {-50, 0, -50}, {50, 4, 50});
  add(scene, {-50, 0, -50}, {50, 0, 50});
  expect_framed(scene, {-50, 0, -50}, {50, 4, 50});
}

TEST(RenderFraming, StepsOfAStaircaseStay) {
  Scene scene;
  for (int i = 0; i < 10; ++i) {
    const auto at = static_cast<float>(i);
    add(scene, {0, 0.2f * at, at}, {4, 0.2f * at + 0.1f, at + 1});
  }
  expect_framed(scene, {0, 0, 0}, {4, 0.2f * 9 + 0.1f, 10});
}

TEST(RenderFraming, WhatCastsNothingIsLeftOut) {
  Scene scene;
  add(scene, {-1, 0, -1}, {1, 2, 1});
  add(scene, {7, 0, 0}, {8, 9, 1}).casting = scene::CastSetting::off;
  add(scene, {-90, -90, -90}, {90, 90, 90}).sky = true;
  expect_framed(scene, {-1, 0, -1}, {1, 2, 1});
  expect_framed(scene, {-90, -90, -90}, {90, 90, 90}, {.skies = true});
}

TEST(RenderFraming, AllIsShownWhereNothingCastsAndTheGroundWhereItIsAlone) {
  Scene scene;
  add(scene, {-1, 0, -1}, {1, 2, 1}).casting = scene::CastSetting::off;
  expect_framed(scene, {-1, 0, -1}, {1, 2, 1});
  Scene plane;
  add(plane, {-50, 0, -50}, {50, 0, 50});
  expect_framed(plane, {-50, 0, -50}, {50, 0, 50});
}

}  // namespace
}  // namespace penumbra

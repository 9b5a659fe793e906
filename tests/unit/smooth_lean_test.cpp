#include "scene/smooth_lean.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>

namespace penumbra::scene {
namespace {

// Two triangles that meet along the y axis, each turned away by `angle` from the plane z = 0; along the axis they share
// the normal z, elsewhere they have their own. Vertices 0 and 1 lie on the axis.
Primitive ridge(float angle, float shared_angle_of_last = -1) {
  Primitive ridge;
  const float c = std::cos(angle), s = std::sin(angle);
  ridge.positions = {{0, -1, 0}, {0, 1, 0}, {c, 0, -s}, {-c, 0, -s}};
  ridge.normals = {{0, 0, 1}, {0, 0, 1}, {s, 0, c}, {-s, 0, c}};
  ridge.indices = {0, 2, 1, 0, 1, 3};
  if (shared_angle_of_last < 0) return ridge;
  // A third triangle at vertex 1 alone, that leans in another way.
  const float t = std::sin(shared_angle_of_last), u = std::cos(shared_angle_of_last);
  ridge.positions.emplace_back(0.5f, 1 + u, t);
  ridge.positions.emplace_back(-0.5f, 1 + u, t);
  ridge.normals.emplace_back(0, 0, 1);
  ridge.normals.emplace_back(0, 0, 1);
  ridge.indices.insert(ridge.indices.end(), {1, 4, 5});
  return ridge;
}

TEST(SmoothLean, IsTheSineOfTheAngleAtTheVerticesOfARound) {
  const float angle = glm::radians(8.0f);
  for (const float lean : smooth_leans(ridge(angle))) EXPECT_NEAR(lean, std::sin(angle), 1e-6f);
}

TEST(SmoothLean, OfAVertexIsTheLargestOfItsTriangles) {
  const std::vector<float> leans = smooth_leans(ridge(glm::radians(4.0f), glm::radians(9.0f)));
  EXPECT_NEAR(leans[0], std::sin(glm::radians(4.0f)), 1e-6f);
  EXPECT_NEAR(leans[1], std::sin(glm::radians(9.0f)), 1e-6f);
}

TEST(SmoothLean, IsTheSameOnBothSidesOfASeam) {
  Primitive seam = ridge(glm::radians(4.0f), glm::radians(9.0f));
  // The third triangle gets a vertex 1 of its own.
  seam.positions.push_back(seam.positions[1]);
  seam.normals.emplace_back(-0.0f, 0.0f, 1.0f);  // the same
  seam.indices[6] = 6;
  const std::vector<float> leans = smooth_leans(seam);
  EXPECT_EQ(leans[6], leans[1]);
  EXPECT_NEAR(leans[1], std::sin(glm::radians(9.0f)), 1e-6f);
}

TEST(SmoothLean, FlatFacesAndSmoothedEdgesHaveNone) {
  for (const float lean : smooth_leans(ridge(0))) EXPECT_EQ(lean, 0);
  for (const float lean : smooth_leans(ridge(glm::radians(31.0f)))) EXPECT_EQ(lean, 0);
  for (const float lean : smooth_leans(ridge(glm::radians(20.0f)))) {
    EXPECT_GT(lean, 0.1f);
    EXPECT_LT(lean, std::sin(glm::radians(20.0f)));
  }
}

TEST(SmoothLean, NeitherWindingNorLengthsMatter) {
  Primitive turned = ridge(glm::radians(8.0f));
  std::swap(turned.indices[0], turned.indices[1]);
  for (glm::vec3& normal : turned.normals) normal *= 7.0f;
  for (glm::vec3& position : turned.positions) position *= 1e-3f;
  for (const float lean : smooth_leans(turned)) EXPECT_NEAR(lean, std::sin(glm::radians(8.0f)), 1e-6f);
}

TEST(SmoothLean, WhatHasNoDirectionHasNone) {
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (const glm::vec3 normal : {glm::vec3(0), glm::vec3(none)}) {
    Primitive primitive = ridge(glm::radians(8.0f));
    std::ranges::fill(primitive.normals, normal);
    for (const float lean : smooth_leans(primitive)) EXPECT_EQ(lean, 0);
  }
  Primitive without_area = ridge(glm::radians(8.0f));
  std::ranges::fill(without_area.positions, glm::vec3(1, 2, 3));
  for (const float lean : smooth_leans(without_area)) EXPECT_EQ(lean, 0);
  Primitive lines = ridge(glm::radians(8.0f));
  lines.topology = Topology::lines;
  EXPECT_EQ(smooth_leans(lines), std::vector<float>(4, 0.0f));
}

}  // namespace
}  // namespace penumbra::scene

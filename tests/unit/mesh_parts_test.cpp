#include "scene/mesh_parts.h"

#include <gtest/gtest.h>

namespace penumbra::scene {
namespace {

// A row of separate triangles along x.
Primitive row(std::uint32_t triangles) {
  Primitive primitive;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const auto x = static_cast<float>(i);
    for (const glm::vec2& corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)}) {
      primitive.indices.push_back(static_cast<std::uint32_t>(primitive.positions.size()));
      primitive.positions.emplace_back(x + corner.x, corner.y, 0);
    }
  }
  return primitive;
}

TEST(MeshParts, HoldEveryTriangleOnceAndInOrder) {
  for (const std::uint32_t triangles : {128u, 129u, 1000u, 100'001u}) {
    const Primitive primitive = row(triangles);
    const std::vector<MeshPart> parts = parts_of(primitive);
    ASSERT_GE(parts.size(), 2u) << triangles;
    EXPECT_LE(parts.size(), 64u) << triangles;
    std::uint32_t next = 0;
    for (const MeshPart& part : parts) {
      EXPECT_EQ(part.first_index, next) << triangles;
      EXPECT_GT(part.index_count, 0u) << triangles;
      EXPECT_EQ(part.index_count % 3, 0u) << triangles;
      const std::uint32_t first = part.first_index / 3;
      const std::uint32_t end = first + part.index_count / 3;
      EXPECT_EQ(part.box.min, glm::vec3(first, 0, 0)) << triangles;
      EXPECT_EQ(part.box.max, glm::vec3(end, 1, 0)) << triangles;
      next += part.index_count;
    }
    EXPECT_EQ(next, 3 * triangles);
  }
}

TEST(MeshParts, ASmallMeshAndLinesHaveNone) {
  EXPECT_TRUE(parts_of(row(127)).empty());
  EXPECT_TRUE(parts_of({}).empty());
  Primitive lines = row(1000);
  lines.topology = Topology::lines;
  EXPECT_TRUE(parts_of(lines).empty());
}

}  // namespace
}  // namespace penumbra::scene

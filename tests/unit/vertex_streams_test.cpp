// Appending many primitives to one stream takes time proportional to their number.

#include <gtest/gtest.h>

#include <cstddef>

#include "scene/gpu_scene_vertices.h"

namespace penumbra::test {
namespace {

TEST(VertexStreams, AreMovedSeldomAsTheyGrow) {
  scene::Primitive triangle;
  triangle.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.normals.assign(3, {0, 0, 1});
  scene::VertexStreams streams;
  std::size_t moves = 0;
  for (int i = 0; i < 20'000; ++i) {
    const std::size_t before = streams.positions.capacity() + streams.frames.capacity() + streams.surfaces.capacity();
    EXPECT_EQ(streams.append(triangle), static_cast<std::uint32_t>(3 * i));
    moves += streams.positions.capacity() + streams.frames.capacity() + streams.surfaces.capacity() != before ? 1 : 0;
  }
  EXPECT_EQ(streams.frames.size(), 60'000u);
  EXPECT_LT(moves, 60u) << "each move copies all that is there";
}

}  // namespace
}  // namespace penumbra::test

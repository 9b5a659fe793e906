// Rays hit only the faces that cast shadows. Front faces are glTF's: counter-clockwise, or clockwise where a node
// mirrors.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "unit/truth_scene.h"

namespace penumbra::test {
namespace {

using scene::CasterFaces;

constexpr std::size_t all_flat = 1'000'000;

// The visibility of a sun overhead below a square 1 m up whose front is towards the sun, or away from it.
float below(bool towards_sun, bool mirrored, CasterFaces faces, std::size_t flat_triangles) {
  TruthScene scene;
  scene::Primitive& grid = scene.add_primitive();
  constexpr std::uint32_t side = 9;  // enough triangles for copies to share them
  for (std::uint32_t z = 0; z < side; ++z)
    for (std::uint32_t x = 0; x < side; ++x)
      grid.positions.emplace_back(-2.0f + 0.5f * static_cast<float>(x), 1.0f, -2.0f + 0.5f * static_cast<float>(z));
  for (std::uint32_t z = 0; z + 1 < side; ++z)
    for (std::uint32_t x = 0; x + 1 < side; ++x) {
      const std::uint32_t a = z * side + x, b = a + side;
      if (towards_sun)
        grid.indices.insert(grid.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
      else
        grid.indices.insert(grid.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
    }
  for (const float at : {0.0f, 100.0f}) {
    glm::mat4 world = glm::translate(glm::mat4(1), glm::vec3(at, 0, 0));
    if (mirrored) world = glm::scale(world, glm::vec3(-1, 1, 1));
    scene::PosedSurface& surface = scene.place(grid, world);
    surface.faces = faces;
    surface.mirrored = mirrored;
  }
  const truth::Tracer tracer = scene.tracer({.flat_triangles = flat_triangles});
  EXPECT_EQ(tracer.stats().instances, flat_triangles == 0 ? 2u : 0u);
  const std::vector<truth::Receiver> receivers{receiver_at({0.1, 0, 0.1}, {0, 1, 0})};
  return trace_row(tracer, receivers, truth::TracedSun{.to_light = {0, 1, 0}, .angle = 0.01}).visibility.at(0);
}

TEST(TruthCasters, CastByTheFacesThatAreChosen) {
  for (const std::size_t flat_triangles : {all_flat, std::size_t{0}})
    for (const bool mirrored : {false, true})
      for (const bool towards_sun : {false, true}) {
        SCOPED_TRACE(::testing::Message() << (mirrored ? "mirrored, " : "") << (towards_sun ? "front" : "back")
                                          << " to the sun, " << (flat_triangles == 0 ? "shared" : "flat"));
        EXPECT_EQ(below(towards_sun, mirrored, CasterFaces::both, flat_triangles), 0);
        EXPECT_EQ(below(towards_sun, mirrored, CasterFaces::front, flat_triangles), towards_sun ? 0 : 1);
        EXPECT_EQ(below(towards_sun, mirrored, CasterFaces::back, flat_triangles), towards_sun ? 1 : 0);
      }
}

}  // namespace
}  // namespace penumbra::test

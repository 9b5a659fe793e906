// The functions that filters of the mask are built from.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <random>

#include "lib/median.glsl"
#include "lib/projection.glsl"

namespace penumbra::glsl {
namespace {

TEST(Median, OfNineIsTheFifthInOrder) {
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    std::array<uint, 9> v{};
    for (uint& one : v) one = static_cast<uint>(random() % (i % 2 == 0 ? 3 : 65536));  // with and without ties
    const uint median = median_of_nine({v[0], v[1], v[2]}, {v[3], v[4], v[5]}, {v[6], v[7], v[8]});
    std::ranges::sort(v);
    ASSERT_EQ(median, v[4]);
  }
}

TEST(Median, OfNineIsRightForEveryArrangementOfTwoValues) {
  for (uint bits = 0; bits < 512; ++bits) {
    const auto bit = [&](uint i) { return (bits >> i) & 1u; };
    const uint median = median_of_nine({bit(0), bit(1), bit(2)}, {bit(3), bit(4), bit(5)}, {bit(6), bit(7), bit(8)});
    EXPECT_EQ(median, std::popcount(bits) >= 5 ? 1u : 0u);
  }
}

TEST(PixelsAMetre, IsTheScreenSizeOfAPlaneThatFacesTheCamera) {
  const float height = 720;
  const float fov = 0.8f;
  const float z = 7;
  const float pixel = 2 * std::tan(fov / 2) * z / height;
  EXPECT_NEAR(pixels_a_metre({0, pixel, 0}, {0, 0, -z}, {0, 0, 1}), height / (2 * std::tan(fov / 2) * z), 1e-3);
}

TEST(PixelsAMetre, IsThatOfTheNextPixelsPointOnTheSamePlane) {
  const vec3 normal = normalize(vec3(0.3f, 0.8f, 0.4f));
  const vec3 point(1, -2, -9);
  for (const vec3& across : {vec3(1e-3f, 0, 0), vec3(0, 1e-3f, 0)}) {
    const glm::dvec3 next_ray = glm::dvec3(point) + glm::dvec3(across);
    const glm::dvec3 n(normal);
    const glm::dvec3 next = next_ray * (glm::dot(n, glm::dvec3(point)) / glm::dot(n, next_ray));
    EXPECT_NEAR(pixels_a_metre(across, point, normal) * glm::distance(next, glm::dvec3(point)), 1, 1e-3);
    EXPECT_FLOAT_EQ(pixels_a_metre(across, point * 5.0f, normal * -3.0f), pixels_a_metre(across, point, normal));
  }
}

TEST(PixelsAMetre, GoesToZeroWhereTheViewGrazes) {
  EXPECT_EQ(pixels_a_metre({0, 0.01f, 0}, {0, 0, -5}, {0, 1, 0}), 0);
  EXPECT_EQ(pixels_a_metre({0.01f, 0, 0}, {0, 0, -5}, {0, 1, 0}), 0) << "nothing of the plane is seen";
}

}  // namespace
}  // namespace penumbra::glsl

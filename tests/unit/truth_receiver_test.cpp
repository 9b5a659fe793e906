// Receivers lie where a pixel's ray meets the drawn triangle's plane.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>

#include "unit/truth_scene.h"

namespace penumbra::test {
namespace {

using truth::EyeRays;
using truth::no_surface;
using truth::Receiver;
using truth::receivers_of;

// Projections with equal x and y but different depth conventions.
struct Projection {
  const char* name;
  glm::dmat4 matrix;
};

constexpr double near = 0.1, far = 60;
constexpr double tan_x = 0.8, tan_y = 0.5;    // perspective
constexpr double half_x = 3.0, half_y = 2.0;  // orthographic

glm::dmat4 projection(bool perspective, double z_scale, double z_shift) {
  glm::dmat4 m(0);
  m[0][0] = 1 / (perspective ? tan_x : half_x);
  m[1][1] = 1 / (perspective ? tan_y : half_y);
  m[2][2] = z_scale;
  m[3][2] = z_shift;
  (perspective ? m[2][3] : m[3][3]) = perspective ? -1 : 1;
  return m;
}

std::vector<Projection> projections(bool perspective) {
  const double range = far - near;
  if (perspective) {
    return {{"reversed, infinite", projection(true, 0, near)},
            {"reversed", projection(true, near / range, near * far / range)},
            {"0 to 1", projection(true, -far / range, -near * far / range)},
            {"-1 to 1", projection(true, -(far + near) / range, -2 * near * far / range)}};
  }
  return {{"reversed", projection(false, 1 / range, far / range)},
          {"0 to 1", projection(false, -1 / range, -near / range)},
          {"-1 to 1", projection(false, -2 / range, -(far + near) / range)}};
}

constexpr int width = 20, height = 10;

// Direction of a pixel's ray in view space, and its point at z = 0.
glm::dvec3 view_ray(int x, int y) {
  return {(2 * (x + 0.5) / width - 1) * tan_x, (2 * (y + 0.5) / height - 1) * tan_y, -1};
}
glm::dvec3 view_start(int x, int y) {
  return {(2 * (x + 0.5) / width - 1) * half_x, (2 * (y + 0.5) / height - 1) * half_y, 0};
}

class Receivers : public testing::TestWithParam<glm::dvec3> {};

TEST_P(Receivers, LieOnThePlaneAndFaceTheEye) {
  const glm::dvec3 eye = GetParam() + glm::dvec3(1, 4, 7);
  const glm::dmat4 view = glm::lookAt(eye, GetParam(), glm::dvec3(0, 1, 0));
  TruthScene scene;
  const glm::vec3 at(GetParam());
  scene.add_triangles({at + glm::vec3(-9, 0, 9), at + glm::vec3(9, 1, 9), at + glm::vec3(9, 2, -9),
                       at + glm::vec3(-9, 0, 9), at + glm::vec3(9, 2, -9), at + glm::vec3(9, 1, 9)});
  for (const bool perspective : {true, false}) {
    for (const Projection& p : projections(perspective)) {
      const EyeRays rays{glm::inverse(p.matrix * view), width, height};
      for (const std::uint32_t triangle : {0U, 1U}) {
        const std::vector<glm::uvec2> drawn(width * height, glm::uvec2(0, triangle));
        const auto receivers = receivers_of(scene.geometry(), rays, drawn);
        const std::uint32_t some[] = {3, 77, 150};
        std::vector<truth::DrawnPixel> pixels;
        for (const std::uint32_t i : some)
          pixels.push_back({{i % static_cast<unsigned>(width), i / static_cast<unsigned>(width)}, drawn[i]});
        const auto subset = receivers_of(scene.geometry(), rays, pixels);
        ASSERT_EQ(subset.size(), 3u);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(subset[i].position, receivers[some[i]].position) << p.name;
        const glm::dvec3 a(glm::vec3(at + glm::vec3(-9, 0, 9)));
        const glm::dvec3 normal = glm::normalize(glm::cross(glm::dvec3(glm::vec3(at + glm::vec3(9, 1, 9))) - a,
                                                            glm::dvec3(glm::vec3(at + glm::vec3(9, 2, -9))) - a));
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            const Receiver& receiver = receivers[static_cast<std::size_t>(y * width + x)];
            ASSERT_TRUE(receiver.there);
            const glm::dvec3 in_view(view * glm::dvec4(receiver.position, 1));
            const glm::dvec3 start = perspective ? glm::dvec3(0) : view_start(x, y);
            const glm::dvec3 ray = perspective ? view_ray(x, y) : glm::dvec3(0, 0, -1);
            const double size = glm::length(in_view);
            EXPECT_LT(glm::length(glm::cross(in_view - start, ray)), 1e-8 * size) << p.name;
            EXPECT_NEAR(glm::dot(receiver.position - a, normal), 0, 1e-11 * glm::length(eye)) << p.name;
            EXPECT_NEAR(std::abs(glm::dot(receiver.normal, normal)), 1, 1e-12) << p.name;
            const glm::dvec3 ray_in_world = glm::transpose(glm::dmat3(view)) * ray;
            EXPECT_LT(glm::dot(receiver.normal, ray_in_world), 0) << p.name << (perspective ? " perspective" : "");
            EXPECT_GE(receiver.extent, 9);
          }
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Near, Receivers, testing::Values(glm::dvec3(0), glm::dvec3(8192, 16, -4096)));

TEST(TruthReceivers, OfNothingPointsAndFlatTrianglesAreNotThere) {
  TruthScene scene;
  scene.add_triangles({{-9, 0, -9}, {9, 0, -9}, {0, 0, 9}});
  scene.add_triangles({{-9, 0, -9}, {9, 0, -9}, {0, 0, -9}});
  scene::Primitive& points = scene.add_primitive();
  points.topology = scene::Topology::points;
  points.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
  points.indices = {0, 1, 2};
  scene.place(points);
  const glm::dmat4 view = glm::lookAt(glm::dvec3(0, 5, 1), glm::dvec3(0), glm::dvec3(0, 1, 0));
  const EyeRays rays{glm::inverse(projections(true)[0].matrix * view), 6, 1};
  const std::vector<glm::uvec2> drawn = {{0, 0}, {no_surface, 0}, {1, 0}, {2, 0}, {0, 1}, {77, 0}};
  const auto receivers = receivers_of(scene.geometry(), rays, drawn);
  EXPECT_TRUE(receivers[0].there);
  for (std::size_t i = 1; i < 6; ++i) EXPECT_FALSE(receivers[i].there) << i;
}

// A triangle seen along its plane, or behind the eye, has no point on the ray: its nearest corner is used instead.
TEST(TruthReceivers, FallBackToTheNearestCorner) {
  TruthScene scene;
  scene.add_triangles({{1, 5, -3}, {-2, 5, -8}, {6, 5, -9}});
  scene.add_triangles({{-4, 6, 2}, {3, 6, 2}, {1, 9, 3}});
  const glm::dmat4 view = glm::translate(glm::dmat4(1), glm::dvec3(0, -5, 0));  // at (0, 5, 0), looking to −Z
  const EyeRays rays{glm::inverse(projections(true)[0].matrix * view), 1, 1};
  const auto along = receivers_of(scene.geometry(), rays, std::vector{glm::uvec2(0, 0)});
  ASSERT_TRUE(along[0].there);
  EXPECT_EQ(along[0].position, glm::dvec3(1, 5, -3));
  const auto behind = receivers_of(scene.geometry(), rays, std::vector{glm::uvec2(1, 0)});
  ASSERT_TRUE(behind[0].there);
  EXPECT_EQ(behind[0].position, glm::dvec3(3, 6, 2));
}

}  // namespace
}  // namespace penumbra::test

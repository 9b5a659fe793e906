// Which geometry casts shadows: no leaks, no acne, contacts, instances, and degenerate triangles.

#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <numbers>

#include "core/error.h"
#include "core/random.h"
#include "truth/posed_triangle.h"
#include "unit/truth_scene.h"

namespace penumbra::test {
namespace {

using truth::Corners;
using truth::Receiver;
using truth::Traced;
using truth::TracedSun;

// A receiver at a point of a surface's triangle, on the side of `outside`.
Receiver receiver_on(const scene::PosedSurface& surface, std::size_t triangle, double u, double v,
                     const glm::dvec3& outside) {
  const Corners corners = truth::world_triangle(surface, triangle).value();
  const glm::dvec3 p = corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
  glm::dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
  if (glm::dot(normal, outside) < 0) normal = -normal;
  double reach = 0;
  for (const glm::dvec3& corner : corners) reach = std::max(reach, glm::length(corner - p));
  return receiver_at(p, normal, reach);
}

// Somewhere on a triangle; often very near a corner or an edge.
glm::dvec2 point_in_triangle(Random& random) {
  glm::dvec2 p(random.real(), random.real());
  if (random.below(3) == 0) p.x = std::pow(10.0, -1 - 5 * random.real());
  if (random.below(3) == 0) p.y = std::pow(10.0, -1 - 5 * random.real());
  if (random.below(3) == 0) p.y = 1 - p.x - 1e-6 * random.real();
  if (p.x + p.y > 1) p = glm::dvec2(1) - p;
  return glm::max(p, glm::dvec2(0));
}

// A ball of many triangles that share their vertices.
scene::Primitive& add_ball(TruthScene& scene, float radius, int rings) {
  scene::Primitive& ball = scene.add_primitive();
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    for (int k = 0; k < around; ++k) {
      const float a = std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(rings);
      const float b = 2 * std::numbers::pi_v<float> * static_cast<float>(k) / static_cast<float>(around);
      ball.positions.emplace_back(radius * std::sin(a) * std::cos(b), radius * std::cos(a),
                                  radius * std::sin(a) * std::sin(b));
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int k = 0; k < around; ++k) {
      const auto at = [&](int ring, int step) { return static_cast<std::uint32_t>(ring * around + step % around); };
      ball.indices.insert(ball.indices.end(), {at(i, k), at(i, k + 1), at(i + 1, k + 1)});
      ball.indices.insert(ball.indices.end(), {at(i, k), at(i + 1, k + 1), at(i + 1, k)});
    }
  }
  return ball;
}

struct Place {
  const char* name;
  glm::vec3 at;
};
const Place places[] = {{"at the origin", {0, 0, 0}},
                        {"1 km away", {1000, 30, -500}},
                        {"10 km away", {10000, 200, -9000}},
                        {"1000 km away", {-1e6f, 0, 3e5f}}};

// Every point of a convex body that faces the whole sun is lit, and no point inside it is.
TEST(TruthGeometry, ConvexBodiesHaveNeitherAcneNorLeaks) {
  const TracedSun sun{.to_light = glm::normalize(glm::dvec3(0.5, 0.6, -0.4)), .angle = glm::radians(3.0)};
  for (const Place& place : places) {
    for (const float radius : {0.5f, 40.0f}) {
      // Far from the origin, vertices are rounded so much that the small ball is no longer convex.
      if (radius < 1e-5f * glm::length(place.at)) continue;
      TruthScene scene;
      const scene::PosedSurface& surface =
          scene.place(add_ball(scene, radius, 30), glm::translate(glm::mat4(1), place.at));
      Random random(3);
      std::vector<Receiver> lit, inside;
      for (std::size_t i = 0; i < truth::triangle_count(surface); ++i) {
        const auto corners = truth::world_triangle(surface, i);
        if (!corners) continue;
        const glm::dvec2 p = point_in_triangle(random);
        const glm::dvec3 outwards = (*corners)[0] - glm::dvec3(place.at);
        const Receiver out = receiver_on(surface, i, p.x, p.y, outwards);
        const Receiver in = receiver_on(surface, i, p.x, p.y, -outwards);
        if (glm::dot(out.normal, sun.to_light) > std::sin(sun.angle / 2) + 1e-6) lit.push_back(out);
        if (glm::dot(in.normal, sun.to_light) > std::sin(sun.angle / 2) + 1e-6) inside.push_back(in);
      }
      // About half of the 3480 triangles that have an area.
      EXPECT_GT(lit.size(), 1500u) << place.name;
      EXPECT_GT(inside.size(), 1500u) << place.name;
      const truth::Tracer tracer = scene.tracer();
      const Traced outside = trace_row(tracer, lit, sun, {.samples = 32});
      EXPECT_EQ(std::ranges::count_if(outside.visibility, [](float v) { return v != 1; }), 0)
          << "acne on a ball of " << radius << " m " << place.name << ", of " << lit.size();
      const Traced within = trace_row(tracer, inside, sun, {.samples = 32});
      EXPECT_EQ(std::ranges::count_if(within.visibility, [](float v) { return v != 0; }), 0)
          << "leaks in a ball of " << radius << " m " << place.name << ", of " << inside.size();
    }
  }
}

// Large askew planes under a low sun, seen from above and below. `apart`: there is another one on the other side of the
// origin, so that coordinates are as large as that, too.
TEST(TruthGeometry, LargePlanesDoNotShadowThemselves) {
  Random random(11);
  for (const Place& place : places) {
    for (int turn = 0; turn < 24; ++turn) {
      const bool apart = turn % 2 == 1;
      TruthScene scene;
      const glm::vec3 axis = glm::normalize(glm::vec3(random.real() - 0.5, random.real() - 0.5, random.real() - 0.5));
      const glm::mat4 world = glm::rotate(glm::translate(glm::mat4(1), place.at), static_cast<float>(turn), axis);
      scene::Primitive& quad = scene.add_primitive();
      quad.positions = {{-100, 0, -100}, {-100, 0, 100}, {100, 0, 100}, {100, 0, -100}};
      quad.indices = {0, 1, 2, 0, 2, 3};
      if (apart) scene.place(quad, glm::translate(glm::mat4(1), -place.at - glm::vec3(0, 300, 0)));
      const scene::PosedSurface& surface = scene.place(quad, world);
      std::vector<Receiver> row;
      for (int i = 0; i < 300; ++i) {
        const glm::dvec2 p = point_in_triangle(random);
        row.push_back(receiver_on(surface, 0, p.x, p.y, {0, 0, 1}));
      }
      // 3 degrees above the plane.
      const glm::dvec3 along = glm::normalize(glm::cross(row[0].normal, glm::dvec3(0.3, 0.8, 0.5)));
      const TracedSun sun{.to_light = along + 0.05 * row[0].normal, .angle = glm::radians(2.0)};
      const Traced traced = trace_row(scene.tracer(), row, sun, {.samples = 16});
      EXPECT_EQ(std::ranges::count_if(traced.visibility, [](float v) { return v != 1; }), 0)
          << place.name << (apart ? ", two" : ", one");
    }
  }
}

// A slab of 4 mm on the ground: its shadow begins at its foot, to the millimetre, and its lit side has none.
TEST(TruthGeometry, ContactShadowsReachTheMillimetre) {
  for (const glm::vec3 at : {glm::vec3(0), glm::vec3(8192, 0, 4096), glm::vec3(-10000, 64, 10000)}) {
    TruthScene scene;
    scene.add_quad(at + glm::vec3(-100, 0, -100), {0, 0, 200}, {200, 0, 0});
    scene.add_box(at, at + glm::vec3(1, 0.004f, 1));
    std::vector<Receiver> behind, before;
    for (int i = 1; i < 200; ++i) {
      const double z = i / 200.0;
      behind.push_back(receiver_at(glm::dvec3(at) + glm::dvec3(-0.001, 0, z), {0, 1, 0}, 200));
      before.push_back(receiver_at(glm::dvec3(at) + glm::dvec3(1.001, 0, z), {0, 1, 0}, 200));
    }
    const truth::Tracer tracer = scene.tracer();
    for (const double height : {0.3, 1.0, 2.0}) {
      const TracedSun sun{.to_light = {1, height, 0}, .angle = glm::radians(0.53)};
      for (const float v : trace_row(tracer, behind, sun, {.samples = 64}).visibility) EXPECT_EQ(v, 0) << height;
      for (const float v : trace_row(tracer, before, sun, {.samples = 64}).visibility) EXPECT_EQ(v, 1) << height;
    }
  }
}

// A box of 5 cm on a ground 20 km wide, whose rounding errors are a millimetre: its shadow begins at its foot, and ends
// a centimetre early at most.
TEST(TruthGeometry, ContactShadowsOnAHugeGround) {
  constexpr float half = 10'000, high = 0.05f;
  TruthScene scene;
  scene.add_quad({-half, 0, -half}, {0, 0, 2 * half}, {2 * half, 0, 0});
  scene.add_box({0, 0, -high}, {high, high, high});
  const double reach = std::numbers::sqrt2 * half;
  const auto beside = [&](double x) { return receiver_at({x, 0, 0}, {0, 1, 0}, reach); };
  const std::vector<Receiver> row{beside(high + 0.001), beside(-0.0001), beside(-0.02), beside(0.01 - high),
                                  beside(-high - 0.001)};
  const TracedSun sun{.to_light = {1, 1, 0}, .angle = glm::radians(0.01)};
  EXPECT_EQ(trace_row(scene.tracer(), row, sun, {.samples = 64}).visibility, (std::vector<float>{1, 0, 0, 0, 1}));
}

// A sheet of hills over `at`, 0.25 m a step.
scene::Primitive& add_hills(TruthScene& scene, const glm::vec3& at, std::uint32_t side) {
  scene::Primitive& hills = scene.add_primitive();
  Random random(2);
  for (std::uint32_t i = 0; i <= side; ++i) {
    for (std::uint32_t k = 0; k <= side; ++k) {
      const auto height = static_cast<float>(4 + random.real());
      hills.positions.push_back(at + glm::vec3(0.25f * static_cast<float>(i), height, 0.25f * static_cast<float>(k)));
    }
  }
  for (std::uint32_t i = 0; i < side; ++i) {
    for (std::uint32_t k = 0; k < side; ++k) {
      const std::uint32_t a = i * (side + 1) + k;
      hills.indices.insert(hills.indices.end(), {a, a + 1, a + side + 2, a, a + side + 2, a + side + 1});
    }
  }
  return hills;
}

// Rays to a point sun that pass through the edges and corners between triangles, to the last bit.
TEST(TruthGeometry, SharedEdgesAreWatertight) {
  constexpr std::uint32_t side = 60;
  const TracedSun sun{.to_light = {0.237, 1, 0.1411}, .angle = 0};
  for (const glm::vec3 at : {glm::vec3(0), glm::vec3(0.1f, 0.3f, -0.7f), glm::vec3(3000, 10, 5000)}) {
    TruthScene scene;
    const scene::Primitive& hills = add_hills(scene, at, side);
    scene.place(hills);
    std::vector<Receiver> row;
    for (std::uint32_t a = 6 * side; a < hills.positions.size() - 6 * side; ++a) {
      if (a % (side + 1) < 6 || a % (side + 1) > side - 6) continue;
      for (const std::uint32_t b : {a, a + 1, a + side + 1, a + side + 2}) {
        for (const double t : {0.17, 0.25, 0.5, 0.77, 0.9}) {
          const glm::dvec3 p = glm::mix(glm::dvec3(hills.positions[a]), glm::dvec3(hills.positions[b]), t);
          row.push_back(receiver_at(p - sun.to_light * (p.y - at.y), {0, 1, 0}, 0));
        }
      }
    }
    const Traced traced = trace_row(scene.tracer(), row, sun, {.samples = 8});
    EXPECT_EQ(std::ranges::count_if(traced.visibility, [](float v) { return v != 0; }), 0) << "of " << row.size();
    EXPECT_EQ(std::ranges::count_if(traced.hard, [](float v) { return v != 0; }), 0) << "of " << row.size();
  }
}

float hard_under(const TruthScene& scene) {
  return trace_row(scene.tracer(), {receiver_at({0.1, 0, 0.2}, {0, 1, 0})}, TracedSun{}).hard[0];
}

TEST(TruthGeometry, TrianglesCastFromBothSides) {
  TruthScene up, down;
  up.add_triangles({{-1, 1, -1}, {0, 1, 2}, {2, 1, -1}});
  down.add_triangles({{-1, 1, -1}, {2, 1, -1}, {0, 1, 2}});
  EXPECT_EQ(hard_under(up), 0);
  EXPECT_EQ(hard_under(down), 0);
}

TEST(TruthGeometry, PointsLinesAndWhatNeverCastsDoNot) {
  for (const scene::Topology topology : {scene::Topology::points, scene::Topology::lines}) {
    TruthScene scene;
    scene::Primitive& primitive = scene.add_primitive();
    primitive.positions = {{-1, 1, -1}, {0, 1, 2}, {2, 1, -1}};
    primitive.indices = {0, 1, 2, 0, 1, 2};
    primitive.topology = topology;
    scene.place(primitive);
    EXPECT_EQ(hard_under(scene), 1);
    primitive.topology = scene::Topology::triangles;
    EXPECT_EQ(hard_under(scene), 0);
  }
  TruthScene never;
  never.add_triangles({{-1, 1, -1}, {0, 1, 2}, {2, 1, -1}}).casts = scene::CastMode::never;
  EXPECT_EQ(hard_under(never), 1);
}

TEST(TruthGeometry, BrokenTrianglesAreSkippedAndOthersOfTheirSurfaceAreNot) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  TruthScene scene;
  scene.add_triangles({{nan, 1, -1}, {0, 1, 2}, {2, 1, -1}});
  scene.add_triangles({{-inf, 1, -1}, {0, 1, 2}, {2, 1, -1}});
  scene.add_triangles({{-1e30f, 1, -1e30f}, {0, 1, 1e30f}, {1e30f, 1, -1e30f}});
  scene.add_triangles({{-1, 1, -1}, {0.1f, 1, 0.2f}, {0.1f, 1, 0.2f}});
  EXPECT_EQ(hard_under(scene), 1);
  scene.add_triangles({{nan, 1, -1}, {0, 1, 2}, {2, 1, -1}, {-1, 1, -1}, {0, 1, 2}, {2, 1, -1}});
  EXPECT_EQ(hard_under(scene), 0);
}

TEST(TruthGeometry, DeformedPositionsCast) {
  TruthScene scene;
  scene::PosedSurface& surface = scene.add_triangles({{-1, 1, -1}, {0, 1, 2}, {2, 1, -1}});
  const std::vector<glm::vec3> deformed = {{9, 1, -1}, {10, 1, 2}, {12, 1, -1}};
  surface.positions = deformed;
  EXPECT_EQ(hard_under(scene), 1);
  surface.world = glm::translate(glm::mat4(1), glm::vec3(-10, 0, 0));
  EXPECT_EQ(hard_under(scene), 0);
}

// Balls at many places, turned, mirrored and stretched, and one squashed flat.
TruthScene many_balls() {
  TruthScene scene;
  const scene::Primitive& ball = add_ball(scene, 0.5f, 8);
  for (int i = 0; i < 60; ++i) {
    const int row = i / 8;
    const glm::vec3 at(0.75f * static_cast<float>(i % 8) - 3, 1.0f + 0.25f * static_cast<float>(i % 3),
                       0.75f * static_cast<float>(row) - 3);
    glm::mat4 world = glm::translate(glm::mat4(1), at);
    if (i % 2 == 0) world = glm::scale(world, {i % 4 == 0 ? -0.5f : 0.5f, 1, 0.5f});
    world = glm::rotate(world, 0.6f * static_cast<float>(i), glm::vec3(0.6f, 0.8f, 0));
    if (i == 59) world = glm::scale(world, {1, 0, 1});
    scene.place(ball, world);
  }
  scene.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  return scene;
}

TEST(TruthGeometry, SharedTrianglesCastAsFlatOnesDo) {
  std::vector<Receiver> ground;
  for (int i = 0; i < 6400; ++i) {
    const int y = i / 80;
    ground.push_back(receiver_at({i % 80 * 0.1 - 4, 0, y * 0.1 - 4}, {0, 1, 0}, 8));
  }
  const TracedSun sun{.to_light = {0.25, 1, 0.5}, .angle = 0.03};
  const TruthScene scene = many_balls();
  const truth::Tracer flat = scene.tracer();
  const truth::Tracer shared = scene.tracer({.flat_triangles = 100});
  EXPECT_EQ(flat.stats().instances, 0U);
  EXPECT_EQ(shared.stats().instances, 59U) << "the flat one does not turn back";
  EXPECT_EQ(shared.stats().triangles, flat.stats().triangles);
  EXPECT_LT(shared.stats().stored, flat.stats().stored / 10);
  const Traced a = flat.trace(ground, 80, sun, {.samples = 64});
  const Traced b = shared.trace(ground, 80, sun, {.samples = 64});
  // Transforming a ray rounds it, so a few rays pass an edge on the other side.
  int differ = 0;
  for (std::size_t i = 0; i < ground.size(); ++i) {
    EXPECT_NEAR(a.visibility[i], b.visibility[i], 1.5 / 64);
    differ += a.visibility[i] != b.visibility[i] ? 1 : 0;
  }
  EXPECT_LE(differ, 6);
}

TEST(TruthGeometry, SharedTrianglesHaveNoAcne) {
  const TruthScene scene = many_balls();
  const truth::Tracer tracer = scene.tracer({.flat_triangles = 100});
  const TracedSun sun{.to_light = {0, 1, 0}, .angle = 0};
  Random random(4);
  std::vector<Receiver> row;
  for (std::size_t i = 0; i < 59; ++i) {
    const scene::PosedSurface& surface = scene.geometry().surfaces[i];
    for (std::size_t k = 0; k < truth::triangle_count(surface); ++k) {
      if (!truth::world_triangle(surface, k)) continue;
      const glm::dvec2 p = point_in_triangle(random);
      const glm::dvec3 center(surface.world[3]);
      const auto corners = truth::world_triangle(surface, k).value();
      const Receiver receiver = receiver_on(surface, k, p.x, p.y, corners[0] - center);
      if (receiver.normal.y > 0.02) row.push_back(receiver);
    }
  }
  // Other objects may shadow a ball: the scene without instances shows where.
  const Traced shared = trace_row(tracer, row, sun, {.samples = 8});
  const Traced flat = trace_row(scene.tracer(), row, sun, {.samples = 8});
  int differ = 0;
  for (std::size_t i = 0; i < row.size(); ++i) differ += shared.hard[i] != flat.hard[i] ? 1 : 0;
  EXPECT_LE(differ, static_cast<int>(row.size() / 1000));
}

// Rays are transformed to the space of each ball, whose vertices are far from that space's own origin.
TEST(TruthGeometry, SharedTrianglesFarFromTheirOriginHaveNoAcne) {
  const TracedSun sun{.to_light = glm::normalize(glm::dvec3(0.5, 0.6, -0.4)), .angle = glm::radians(3.0)};
  for (const auto& [away, apart] :
       {std::pair(0.0f, 200.0f), {1000.0f, 200.0f}, {10000.0f, 200.0f}, {10000.0f, 20000.0f}}) {
    TruthScene scene;
    scene::Primitive& ball = add_ball(scene, 40, 30);
    for (glm::vec3& p : ball.positions) p.x += away;
    for (const float down : {0.0f, apart}) scene.place(ball, glm::translate(glm::mat4(1), glm::vec3(-away, -down, 0)));
    const truth::Tracer tracer = scene.tracer({.flat_triangles = 100});
    EXPECT_EQ(tracer.stats().instances, 2U);
    Random random(5);
    std::vector<Receiver> lit;
    for (const scene::PosedSurface& surface : scene.geometry().surfaces) {
      // Without those at the poles, some of which have no area.
      for (std::size_t i = 120; i + 120 < truth::triangle_count(surface); ++i) {
        const glm::dvec2 p = point_in_triangle(random);
        const glm::dvec3 corner = truth::world_triangle(surface, i).value()[0];
        const Receiver out = receiver_on(surface, i, p.x, p.y, corner - glm::dvec3(0, surface.world[3].y, 0));
        if (glm::dot(out.normal, sun.to_light) > std::sin(sun.angle / 2) + 0.01) lit.push_back(out);
      }
    }
    EXPECT_GT(lit.size(), 3000u) << away;
    const Traced traced = trace_row(tracer, lit, sun, {.samples = 32});
    EXPECT_EQ(std::ranges::count_if(traced.visibility, [](float v) { return v != 1; }), 0) << away;
  }
}

TEST(TruthGeometry, TooLittleMemoryIsAnErrorInOneLine) {
  TruthScene scene;
  scene.place(add_ball(scene, 1, 100));
  EXPECT_GT(scene.tracer().stats().memory, 100'000U);
  try {
    scene.tracer({.memory = 100'000});
    FAIL() << "the limit is not kept";
  } catch (const Error& e) {
    EXPECT_STREQ(e.what(), "ray tracing: not enough memory for 40000 triangles");
  }
}

}  // namespace
}  // namespace penumbra::test

// The functions of glsl/lib, compiled as C++, against closed forms.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lib/disc.glsl"
#include "lib/hash.glsl"
#include "lib/kernel.glsl"
#include "lib/octahedral.glsl"
#include "lib/triangle_normal.glsl"

namespace penumbra::glsl {
namespace {

vec3 direction(int i, int count) {
  const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
  const float angle = 2.39996323f * static_cast<float>(i);
  const float r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

TEST(Octahedral, RoundTripsEveryDirection) {
  for (int i = 0; i < 10000; ++i) {
    const vec3 v = direction(i, 10000);
    const vec2 e = octahedral_encode(v);
    EXPECT_LE(std::max(std::abs(e.x), std::abs(e.y)), 1.0f);
    EXPECT_LT(length(octahedral_decode(e) - v), 2e-6f);
  }
}

TEST(Octahedral, RoundTripsTheAxes) {
  for (const vec3& v : {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1)}) {
    EXPECT_LT(length(octahedral_decode(octahedral_encode(v)) - v), 1e-6f);
  }
}

TEST(TriangleNormal, PointsToTheCounterClockwiseSideAtAnySize) {
  for (const float size : {1e-30f, 1e-12f, 1.0f, 1e12f, 1e30f}) {
    const vec3 a(0), b(2 * size, 0, 0), c(0, 3 * size, 0);
    EXPECT_LT(length(normalize(triangle_normal(a, b, c)) - vec3(0, 0, 1)), 1e-6f) << size;
    EXPECT_LT(length(normalize(triangle_normal(a, c, b)) - vec3(0, 0, -1)), 1e-6f) << size;
  }
}

TEST(TriangleNormal, IsZeroWithoutArea) {
  const vec3 a(1, 2, 3);
  EXPECT_EQ(triangle_normal(a, a, a), vec3(0));
  EXPECT_EQ(triangle_normal(a, a, a + vec3(1)), vec3(0));
  EXPECT_EQ(triangle_normal(a, a + vec3(1), a + vec3(2)), vec3(0));
}

TEST(ConcentricDisc, KeepsAreas) {
  // The share of a fine grid's points that lands within radius r of the centre is r squared.
  const int n = 512;
  for (const float r : {0.25f, 0.5f, 0.75f, 1.0f}) {
    int inside = 0;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const vec2 p = concentric_disc({(static_cast<float>(x) + 0.5f) / n, (static_cast<float>(y) + 0.5f) / n});
        if (length(p) <= r) ++inside;
      }
    }
    EXPECT_NEAR(static_cast<double>(inside) / (n * n), r * r, 0.002) << "radius " << r;
  }
}

TEST(ConcentricDisc, MapsCentreEdgesAndQuadrants) {
  EXPECT_EQ(concentric_disc(vec2(0.5f)), vec2(0));
  EXPECT_NEAR(length(concentric_disc({0.999999f, 0.3f})), 1, 1e-5);
  EXPECT_NEAR(length(concentric_disc({0.2f, 0})), 1, 1e-5);
  for (const vec2& u : {vec2(0.9f, 0.6f), vec2(0.1f, 0.6f), vec2(0.1f, 0.2f), vec2(0.6f, 0.1f)}) {
    const vec2 p = concentric_disc(u);
    EXPECT_GT(p.x * (u.x - 0.5f), 0);
    EXPECT_GT(p.y * (u.y - 0.5f), 0);
  }
}

TEST(ToroidalShift, WrapsIntoTheUnitSquare) {
  const vec2 p = toroidal_shift({0.75f, 0.25f}, {0.5f, 0.5f});
  EXPECT_FLOAT_EQ(p.x, 0.25f);
  EXPECT_FLOAT_EQ(p.y, 0.75f);
}

TEST(WhiteNoise, IsUniformAndDiffersByPixelAndSeed) {
  double sum = 0;
  double squares = 0;
  double product = 0;
  const int n = 256;
  for (uint y = 0; y < n; ++y) {
    for (uint x = 0; x < n; ++x) {
      const vec2 v = white_noise({x, y}, 3);
      ASSERT_GE(std::min(v.x, v.y), 0.0f);
      ASSERT_LT(std::max(v.x, v.y), 1.0f);
      sum += v.x;
      squares += v.x * v.x;
      product += (v.x - 0.5) * (white_noise({x + 1, y}, 3).x - 0.5);
    }
  }
  const double count = n * n;
  EXPECT_NEAR(sum / count, 0.5, 0.005);
  EXPECT_NEAR(squares / count, 1.0 / 3, 0.005);
  EXPECT_NEAR(product / count, 0, 0.002) << "neighbours are correlated";
  EXPECT_NE(white_noise({5, 9}, 0), white_noise({5, 9}, 1));
}

TEST(Kernel, PenumbraRadiusFollowsSimilarTriangles) {
  EXPECT_FLOAT_EQ(sun_penumbra_radius(0.01f, 6), 0.06f);
  EXPECT_EQ(sun_penumbra_radius(0.01f, -6), 0) << "a surface behind the receiver is no blocker";
}

TEST(Kernel, PlaneGradientGivesTheDepthOfThePlane) {
  const vec3 normal = normalize(vec3(0.3f, -0.5f, -0.7f));
  const vec2 gradient = plane_gradient(normal, 100);
  for (const vec2& offset : {vec2(1, 0), vec2(0, 1), vec2(-2, 3)}) {
    const vec3 on_plane(offset.x, offset.y, dot(gradient, offset));
    EXPECT_NEAR(dot(on_plane, normal), 0, 1e-6);
  }
}

TEST(Kernel, PlaneGradientIsLimitedWhereTheLightGrazes) {
  const vec2 gradient = plane_gradient(normalize(vec3(1, 0.5f, -1e-9f)), 50);
  EXPECT_NEAR(length(gradient), 50, 1e-3);
}

// Of lit faces that rise so much per metre to each side.
Surroundings faces(const vec4& slopes, float steepest) { return {slopes, steepest, 0, 0}; }

TEST(Kernel, TexelsBlockBeforeTheReceiverItsPlaneAndTheFacesBesideIt) {
  const vec4 x(-1, 1, 0, -1);
  const vec4 y(0, 0, -1, 1);
  const vec4 plane = 2.0f * x;
  const vec4 alone = blocking_depths(10, plane, faces(vec4(0), 100), x, y, 0.1f);
  EXPECT_FLOAT_EQ(alone.x, 7.9f) << "the plane rises to the light";
  EXPECT_FLOAT_EQ(alone.y, 9.9f) << "the plane falls away";
  const vec4 beside = blocking_depths(10, plane, faces(vec4(3, 0, 0, 5), 100), x, y, 0.1f);
  EXPECT_FLOAT_EQ(beside.y, 8.9f) << "a face rises above the plane on that side";
  EXPECT_FLOAT_EQ(beside.z, 4.9f) << "and on that";
  EXPECT_FLOAT_EQ(beside.w, 7.9f) << "elsewhere the plane decides";
  const vec4 capped = blocking_depths(10, plane, faces(vec4(3, 0, 0, 5), 4), x, y, 0.1f);
  EXPECT_FLOAT_EQ(capped.y, 8.9f);
  EXPECT_FLOAT_EQ(capped.z, 5.9f) << "no face is steeper than that";
}

TEST(Kernel, TexelsBlockBehindACoveredReceiverWhereTheyLieBeforeItsPlane) {
  const vec4 x(-1, 1, 2, 1);
  const vec4 y(0, 0, 0, -1);
  const vec4 depths = blocking_depths(10, 2.0f * x, {vec4(0), 100, 1.5f, 0}, x, y, 0.1f);
  EXPECT_FLOAT_EQ(depths.x, 7.9f) << "the plane rises to the light";
  EXPECT_FLOAT_EQ(depths.y, 11.9f) << "the plane falls away, but its texel is near";
  EXPECT_FLOAT_EQ(depths.z, 9.9f) << "this one is not";
  EXPECT_FLOAT_EQ(depths.w, 11.9f);
}

TEST(Kernel, TexelsThatTheMapCannotTellFromTheReceiversSurfaceDoNotBlock) {
  const vec4 x(-1, 1, 0, 0);
  const vec4 depths = blocking_depths(10, 2.0f * x, {vec4(0), 100, 0, 0.5f}, x, vec4(0), 0.1f);
  EXPECT_FLOAT_EQ(depths.x, 7.4f);
  EXPECT_FLOAT_EQ(depths.y, 9.4f);
}

TEST(Kernel, TheConeHoldsWhatCanHideTheLight) {
  const vec4 x(0.9f, 1.2f, 0.9f, 1.6f);
  const vec4 y(0, 0, 0.9f, 0);
  EXPECT_EQ(within_cone(vec4(1), false, x, y), vec4(1, 0, 0, 0)) << "a disc of radius 1";
  EXPECT_EQ(within_cone(vec4(1), true, x, y), vec4(1, 0, 1, 0)) << "a square";
  EXPECT_EQ(within_cone(vec4(1, 1, 1, 2), false, x, y), vec4(1, 0, 0, 1)) << "each texel has its own";
}

TEST(Kernel, CoveringLevelHoldsTheDiscInTwoTexels) {
  for (float radius = 0.01f; radius < 40; radius *= 1.3f) {
    const float texel = 0.1f * std::exp2(static_cast<float>(covering_level(radius, 0.1f, 12)));
    EXPECT_GE(texel, 2 * radius * 0.9999f);
    EXPECT_LE(texel, std::max(4 * radius * 1.0001f, 0.1f)) << "a coarser level than needed";
  }
  for (int level = 0; level < 11; ++level) {
    const float radius = std::exp2(static_cast<float>(level - 1));
    EXPECT_EQ(covering_level(radius, 1, 12), level) << "a disc as wide as two texels";
    EXPECT_EQ(covering_level(std::nextafter(radius, 2 * radius), 1, 12), level + 1) << "a wider one";
  }
  EXPECT_EQ(covering_level(std::numeric_limits<float>::infinity(), 1, 12), 11);
  EXPECT_EQ(covering_level(1e9f, 0.1f, 12), 11);
  EXPECT_EQ(covering_level(0, 0.1f, 12), 0);
}

}  // namespace
}  // namespace penumbra::glsl

// Traced penumbrae against closed forms: the size of the error, how fast it falls with the number of rays, and whether
// the reported error is the actual one.

#include <gtest/gtest.h>

#include <cstdio>

#include "unit/truth_scene.h"

namespace penumbra::test {
namespace {

using truth::LocalLight;
using truth::Receiver;
using truth::Traced;
using truth::TracedSun;

constexpr double edge_height = 5;

// A half-plane x < 0 at 5 m, as in scenes/knife_edge.glb.
TruthScene knife_edge() {
  TruthScene scene;
  scene.add_quad({-100, 0, -100}, {0, 0, 200}, {200, 0, 0});
  scene.add_quad({-60, edge_height, -60}, {60, 0, 0}, {0, 0, 120});
  return scene;
}

struct Row {
  std::vector<Receiver> receivers;
  std::vector<double> exact;
};

// Receivers across a penumbra, and beyond it on both sides by `beyond` times its half width.
template <class Exact>
Row row_across(double half_width, double beyond, int count, Exact exact) {
  const double reach = (1 + beyond) * half_width;
  Row row{ground_row(-reach, reach, count), {}};
  for (const Receiver& receiver : row.receivers) row.exact.push_back(exact(receiver.position.x / half_width));
  return row;
}

double square_share(double t) { return 0.5 + 0.5 * std::clamp(t, -1.0, 1.0); }

TEST(TruthPenumbra, IsTheExactFunctionOfDiscAndSquare) {
  const TruthScene scene = knife_edge();
  const truth::Tracer tracer = scene.tracer();
  for (const double angle : {0.53, 2.0, 8.0}) {
    const double radius = edge_height * std::tan(glm::radians(angle) / 2);
    for (const bool square : {false, true}) {
      const Row row = row_across(radius, 0.25, 500, square ? square_share : disc_share);
      const TracedSun sun{.angle = glm::radians(angle), .square = square};
      const Traced traced = trace_row(tracer, row.receivers, sun, {.samples = 4096});
      EXPECT_LT(rmse(traced.visibility, row.exact), 0.001) << angle << (square ? " square" : " disc");
      EXPECT_LT(largest_error(traced.visibility, row.exact), 0.005) << angle << (square ? " square" : " disc");
      EXPECT_EQ(traced.samples, 4096);
      for (std::size_t i = 0; i < row.exact.size(); ++i) {
        EXPECT_EQ(traced.hard[i], row.receivers[i].position.x > 0 ? 1 : 0);
      }
    }
  }
}

// An oblique sun and an edge that is not aligned with the disc's axes, so that no symmetry hides errors.
Row oblique_row(const TracedSun& sun, int count) {
  const double tangent = std::tan(sun.angle / 2);
  const glm::dvec3 to_light = glm::normalize(sun.to_light);
  const glm::dvec3 u = glm::normalize(glm::cross(to_light, glm::dvec3(0.3, 0.2, 0.9)));
  const glm::dvec3 w = glm::cross(to_light, u);
  // A ray from x misses the half-plane where this is positive.
  const auto miss = [](const glm::dvec3& d, double x) { return edge_height * d.x + x * d.y; };
  const auto share = [&](double x) {
    return disc_share(miss(to_light, x) / (tangent * std::hypot(miss(u, x), miss(w, x))));
  };
  const double middle = -edge_height * to_light.x / to_light.y;
  const double half = 1.1 * edge_height * tangent / (to_light.y * to_light.y);
  Row row{ground_row(middle - half, middle + half, count), {}};
  for (const Receiver& receiver : row.receivers) row.exact.push_back(share(receiver.position.x));
  return row;
}

TEST(TruthPenumbra, ErrorFallsAsSamplesToTheMinusSevenTenthsOrSteeper) {
  const TruthScene scene = knife_edge();
  const truth::Tracer tracer = scene.tracer();
  const TracedSun sun{.to_light = {0.7, 1, 0.5}, .angle = glm::radians(4.0)};
  const Row row = oblique_row(sun, 600);
  std::vector<double> x, y;
  for (int samples = 64; samples <= 4096; samples *= 2) {
    const Traced traced = trace_row(tracer, row.receivers, sun, {.samples = samples});
    x.push_back(std::log(samples));
    y.push_back(std::log(rmse(traced.visibility, row.exact)));
    std::printf("%d samples: RMSE %.5f\n", samples, std::exp(y.back()));
  }
  const auto n = static_cast<double>(x.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    sxy += x[i] * y[i];
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  std::printf("RMSE falls as N^%.3f\n", slope);
  EXPECT_LE(slope, -0.7);
}

TEST(TruthPenumbra, StandardErrorIsHonest) {
  const TruthScene scene = knife_edge();
  const truth::Tracer tracer = scene.tracer();
  const TracedSun sun{.to_light = {0.7, 1, 0.5}, .angle = glm::radians(4.0)};
  const Row row = oblique_row(sun, 2000);
  for (const int samples : {64, 256, 1024}) {
    const Traced traced = trace_row(tracer, row.receivers, sun, {.samples = samples});
    double errors = 0, estimates = 0, ratios = 0, within = 0, count = 0;
    for (std::size_t i = 0; i < row.exact.size(); ++i) {
      if (row.exact[i] < 0.02 || row.exact[i] > 0.98 || traced.standard_error[i] == 0) continue;
      const double error = traced.visibility[i] - row.exact[i];
      const double estimate = traced.standard_error[i];
      errors += error * error;
      estimates += estimate * estimate;
      ratios += error * error / (estimate * estimate);
      within += std::abs(error) <= 2.365 * estimate ? 1 : 0;
      ++count;
    }
    ASSERT_GT(count, 1400);
    // Student's t with 7 degrees of freedom: variance 7/5, and 95 % within 2.365.
    EXPECT_NEAR(std::sqrt(errors / estimates), 1, 0.1) << samples;
    EXPECT_GT(std::sqrt(ratios / count), 0.7) << samples;
    EXPECT_LT(std::sqrt(ratios / count), 1.4) << samples;
    EXPECT_NEAR(within / count, 0.95, 0.02) << samples;
  }
}

// A square sun has two horizontal sides, whatever its direction.
TEST(TruthPenumbra, SquareSunHasHorizontalSides) {
  TruthScene scene;
  scene.add_quad({-100, 0, -100}, {0, 0, 200}, {200, 0, 0});
  scene.add_quad({-60, edge_height, -60}, {60, 0, 0}, {0, 0, 120});
  const truth::Tracer tracer = scene.tracer();
  const double angle = glm::radians(6.0);
  const TracedSun sun{.to_light = {0.8, 0.6, 0}, .angle = angle, .square = true};
  // The sun's horizontal sides are parallel to the edge, so the edge cuts the sun parallel to them.
  const double tangent = std::tan(angle / 2);
  Row row{ground_row(-8, -5.6, 400), {}};
  for (const Receiver& receiver : row.receivers) {
    const double x = receiver.position.x;
    row.exact.push_back(square_share((edge_height * 0.8 + x * 0.6) / (tangent * (edge_height * 0.6 - x * 0.8))));
  }
  const Traced traced = trace_row(tracer, row.receivers, sun, {.samples = 4096});
  EXPECT_LT(rmse(traced.visibility, row.exact), 0.001);
  EXPECT_LT(largest_error(traced.visibility, row.exact), 0.005);
}

TEST(TruthPenumbra, OfLocalLightsIsExact) {
  const TruthScene scene = knife_edge();
  const truth::Tracer tracer = scene.tracer();
  const glm::dvec3 place(0.4, 8, 0);
  const double radius = 0.5;
  Row sphere{ground_row(-2, 2, 400), {}};
  for (const Receiver& receiver : sphere.receivers) {
    const double x = receiver.position.x;
    const glm::dvec3 d = place - receiver.position;
    // Rays d + radius · u · side pass the edge where (x · y + height · x) of their direction is positive.
    const auto miss = [&](const glm::dvec3& v) { return x * v.y + edge_height * v.x; };
    const glm::dvec3 facing = glm::normalize(glm::dvec3(d.y, -d.x, 0));
    sphere.exact.push_back(disc_share(miss(d) / (radius * std::abs(miss(facing)))));
  }
  const Traced traced = trace_row(tracer, sphere.receivers, LocalLight{place, radius}, {.samples = 4096});
  EXPECT_LT(rmse(traced.visibility, sphere.exact), 0.001);
  EXPECT_LT(largest_error(traced.visibility, sphere.exact), 0.005);
}

TEST(TruthPenumbra, WhatIsBehindALocalLightDoesNotBlockIt) {
  TruthScene scene;
  scene.add_quad({-9, 6, -9}, {18, 0, 0}, {0, 0, 18});
  const truth::Tracer tracer = scene.tracer();
  const auto row = ground_row(-3, 3, 64);
  for (const float visibility : trace_row(tracer, row, LocalLight{{0, 5, 0}, 0.5}).visibility) {
    EXPECT_EQ(visibility, 1);
  }
  for (const float visibility : trace_row(tracer, row, LocalLight{{0, 7, 0}, 0.5}).visibility) {
    EXPECT_EQ(visibility, 0);
  }
}

// What is nearer to a lamp's plane than this, as seen from the receiver, belongs to the lamp.
TEST(TruthPenumbra, WhatIsVeryNearALocalLightDoesNotBlockIt) {
  TruthScene scene;
  scene.add_quad({-9, 4.75f, -9}, {18, 0, 0}, {0, 0, 18});
  const truth::Tracer tracer = scene.tracer();
  const auto row = ground_row(-3, 3, 60);
  for (const double clear : {0.0, 0.24, 0.27, 0.3, 20.0}) {
    const Traced traced = trace_row(tracer, row, LocalLight{.position = {0, 5, 0}, .radius = 1e-4, .clear = clear});
    for (std::size_t i = 0; i < row.size(); ++i) {
      const float lit = 0.05 * glm::length(row[i].position - glm::dvec3(0, 5, 0)) < clear ? 1 : 0;
      EXPECT_EQ(traced.visibility[i], lit) << clear << ", " << row[i].position.x;
      EXPECT_EQ(traced.hard[i], lit) << clear << ", " << row[i].position.x;
    }
  }
}

TEST(TruthPenumbra, ASpotShinesWithinItsConeAndItsRange) {
  const TruthScene scene;
  const truth::Tracer tracer = scene.tracer();
  const auto row = ground_row(-6, 6, 120);
  const LocalLight everywhere{.position = {0, 5, 0}, .radius = 0.1};
  LocalLight cone = everywhere, range = everywhere, both = everywhere;
  cone.cone = both.cone = truth::SpotCone{.axis = {0, -1, 0}, .cosine = std::cos(glm::radians(40.0))};
  range.range = 5.5;
  both.range = 5.2;
  const auto within = [](double most) { return [=](double x) { return std::abs(x) <= most; }; };
  const double rim = 5 * std::tan(glm::radians(40.0));
  const auto expect = [&](const LocalLight& light, const auto& shines) {
    const Traced traced = trace_row(tracer, row, light);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const float lit = shines(row[i].position.x) ? 1 : 0;
      EXPECT_EQ(traced.visibility[i], lit) << row[i].position.x;
      EXPECT_EQ(traced.hard[i], lit) << row[i].position.x;
    }
  };
  expect(everywhere, within(10));
  expect(cone, within(rim));
  expect(range, within(std::sqrt(5.5 * 5.5 - 25)));
  expect(both, within(std::sqrt(5.2 * 5.2 - 25)));
}

// The part of the sun's disc below a receiver's horizon does not light it.
TEST(TruthPenumbra, ASunHalfBelowTheSurfaceIsHalfVisible) {
  const TruthScene scene;
  const truth::Tracer tracer = scene.tracer();
  const double angle = glm::radians(8.0);
  std::vector<Receiver> receivers;
  std::vector<double> exact;
  for (int i = 0; i < 200; ++i) {
    const double t = -1.2 + 2.4 * (i + 0.5) / 200;
    const double elevation = std::atan(t * std::tan(angle / 2));
    receivers.push_back(receiver_at({0, 0, 0}, {std::sin(elevation), std::cos(elevation), 0}));
    exact.push_back(disc_share(t));
  }
  const Traced traced =
      trace_row(tracer, receivers, TracedSun{.to_light = {1, 0, 0}, .angle = angle}, {.samples = 4096});
  EXPECT_LT(rmse(traced.visibility, exact), 0.001);
  EXPECT_LT(largest_error(traced.visibility, exact), 0.005);
}

}  // namespace
}  // namespace penumbra::test

#include "shadow/cascades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "shadow/light_projection.h"

namespace penumbra::shadow {
namespace {

CascadeInputs courtyard() {
  CascadeInputs in;
  in.view = glm::lookAt(glm::vec3(3, 1.7f, 8), glm::vec3(0, 1, 0), glm::vec3(0, 1, 0));
  in.projection = glm::perspective(0.9f, 16.0f / 9.0f, 0.1f, 200.0f);
  in.to_light = glm::normalize(glm::vec3(0.4f, 0.7f, 0.2f));
  in.tan_half_angle = 0.0046f;
  in.casters = in.receivers = {{-20, 0, -40}, {20, 9, 12}};
  return in;
}

glm::dvec3 clip(const Cascade& cascade, const glm::dvec3& p) {
  const glm::dvec4 c = cascade.world_to_clip * glm::dvec4(p, 1);
  return glm::dvec3(c) / c.w;
}

TEST(Cascades, TheLastHoldsAllThatTheViewSeesOfTheScene) {
  const CascadeInputs in = courtyard();
  const Cascades cascades = fit_cascades(in);
  const glm::dmat4 view_projection = glm::dmat4(in.projection) * glm::dmat4(in.view);
  int seen = 0;
  for (float x = -20; x <= 20; x += 2) {
    for (float z = -40; z <= 12; z += 2) {
      const glm::dvec4 c = view_projection * glm::dvec4(x, 0, z, 1);
      if (c.w <= 0 || std::abs(c.x) > c.w || std::abs(c.y) > c.w) continue;
      ++seen;
      const glm::dvec3 p = clip(cascades.items.back(), {x, 0, z});
      EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 1.0) << x << ", " << z;
      EXPECT_GE(p.z, 0);
      EXPECT_LE(p.z, 1);
    }
  }
  EXPECT_GT(seen, 50);
}

// Points of the view's frustum up to a distance.
std::vector<glm::dvec3> frustum_points(const CascadeInputs& in, double distance) {
  const glm::dmat4 to_world = glm::inverse(glm::dmat4(in.view));
  std::vector<glm::dvec3> points;
  for (const double depth : {0.1 * distance, 0.5 * distance, distance}) {
    for (const double x : {-1.0, 0.0, 1.0}) {
      for (const double y : {-1.0, 0.0, 1.0}) {
        const glm::dvec4 p(x * depth / in.projection[0][0], y * depth / in.projection[1][1], -depth, 1);
        points.emplace_back(to_world * p);
      }
    }
  }
  return points;
}

// Its near plane lies behind the camera, as in editors whose camera is somewhere in the scene.
TEST(Cascades, TheLastHoldsWhatAnOrthographicViewShowsBehindItsCamera) {
  CascadeInputs in = courtyard();
  in.projection = glm::ortho(-30.0f, 30.0f, -30.0f, 30.0f, -100.0f, 100.0f);
  in.casters = in.receivers = {{-200, 0, -200}, {200, 9, 200}};
  in.view = glm::lookAt(glm::vec3(-20, 5, -20), glm::vec3(0, 5, 0), glm::vec3(0, 1, 0));
  // How far beyond the last cascade's map the outermost receivers of the picture are at that depth, 1: on its border.
  const auto reach = [&](double depth) {
    double most = 0;
    for (const glm::dvec2& corner : {glm::dvec2(-30, -5), {30, -5}, {30, 4}, {-30, 4}}) {
      const glm::dvec4 world = glm::inverse(glm::dmat4(in.view)) * glm::dvec4(corner, -depth, 1);
      const glm::dvec3 p = clip(fit_cascades(in).items.back(), world);
      most = std::max({most, std::abs(p.x), std::abs(p.y)});
    }
    return most;
  };
  in.nearest = -100;
  for (const double depth : {-100.0, -60.0, 0.0, 60.0, 100.0}) EXPECT_LE(reach(depth), 1) << depth;
  in.nearest = 0;
  EXPECT_GT(reach(-100), 1) << "maps do not hold what the view does not show";
}

TEST(Cascades, TheNearPlaneOfAnOrthographicViewMayBeAnywhereBehindTheReceivers) {
  CascadeInputs in = courtyard();
  in.projection = glm::ortho(-30.0f, 30.0f, -30.0f, 30.0f, -100.0f, 100.0f);
  in.casters = in.receivers = {{-200, 0, -200}, {200, 9, 200}};
  in.view = glm::lookAt(glm::vec3(-50, 50, -50), glm::vec3(0), glm::vec3(0, 1, 0));
  const float texel = fit_cascades(in).texel(3).x;
  in.nearest = -20000;
  EXPECT_EQ(fit_cascades(in).texel(3).x, texel);
  // Where receivers may be behind the camera too, a chosen range holds there as well.
  in.receivers = {glm::vec3(-20000), glm::vec3(20000)};
  in.distance = 30;
  in.nearest = 0;
  const float before = fit_cascades(in).texel(3).x;
  in.nearest = -20000;
  EXPECT_LT(fit_cascades(in).texel(3).x, 3 * before);
}

// As Lengyel 2005 and others scale them, and as cameras beside the middle of their picture have them.
TEST(Cascades, AProjectionMayBeScaledAsAWhole) {
  const auto expect_corner = [](const glm::dmat4& projection, double depth) {
    const glm::dvec3 corner = frustum_corner(projection, depth, 0.5, -1);
    const glm::dvec4 at = projection * glm::dvec4(corner, 1);
    EXPECT_NEAR(at.x / at.w, 0.5, 1e-12);
    EXPECT_NEAR(at.y / at.w, -1, 1e-12);
    EXPECT_EQ(corner.z, -depth);
  };
  for (const double scale : {1.0, 4.0, 0.1}) {
    expect_corner(scale * glm::frustum(-0.3, 0.9, -0.2, 0.7, 1.0, 50.0), 20);
    expect_corner(scale * glm::ortho(-3.0, 9.0, -2.0, 7.0, 1.0, 50.0), 20);
    expect_corner(scale * glm::ortho(-3.0, 9.0, -2.0, 7.0, -50.0, 50.0), -20);
  }
}

TEST(Cascades, GrowAndNest) {
  CascadeInputs in = courtyard();
  in.receivers = {{-500, 0, -500}, {500, 9, 500}};
  in.distance = 100;
  in.split_blend = 0;
  for (const auto& [count, size] : {std::pair(2, 2048), {4, 2048}, {8, 2048}, {4, 12}, {4, 16}, {4, 20}}) {
    in.count = count;
    in.size = size;
    const Cascades cascades = fit_cascades(in);
    ASSERT_EQ(cascades.items.size(), static_cast<size_t>(count));
    for (size_t i = 0; i < cascades.items.size(); ++i) {
      // A cascade contains all of the view up to its range, and so the view's part of every finer cascade.
      const double range = in.distance * static_cast<double>(i + 1) / count;
      for (const glm::dvec3& point : frustum_points(in, range)) {
        const glm::dvec3 p = clip(cascades.items[i], point);
        EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 1.0) << "cascade " << i << " of " << count;
      }
      if (i == 0) continue;
      EXPECT_LT(cascades.items[i - 1].half_extent.x, cascades.items[i].half_extent.x);
    }
  }
}

TEST(Cascades, TheLastHoldsTheWholeDiscOfEveryReceiver) {
  for (const float elevation : {30.0f, 60.0f, 90.0f}) {
    CascadeInputs in = courtyard();
    in.to_light = {std::cos(glm::radians(elevation)), std::sin(glm::radians(elevation)), 0};
    in.tan_half_angle = std::tan(glm::radians(5.0f));
    in.distance = 10;
    in.casters = {{-1000, 0, -1000}, {1000, 300, 1000}};
    const Cascades cascades = fit_cascades(in);
    int seen = 0;
    const glm::dmat3 to_world = glm::transpose(cascades.world_to_light);
    const double tangent = in.tan_half_angle;
    for (const glm::dvec3& point : frustum_points(in, in.distance)) {
      for (const glm::dvec2& side : {glm::dvec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        // Where the edge of the light's cone reaches the top of the casters' bounding box.
        const glm::dvec3 along = to_world * glm::dvec3(tangent * side, -1);
        const glm::dvec3 caster = point + along * ((300 - point.y) / along.y);
        if (glm::any(glm::greaterThan(glm::abs(caster), glm::dvec3(1000)))) continue;
        ++seen;
        const glm::dvec3 p = clip(cascades.items.back(), caster);
        EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 1.0) << elevation << " degrees";
        EXPECT_GE(p.z, 0) << elevation << " degrees";
      }
    }
    EXPECT_GT(seen, 50) << elevation << " degrees";
  }
}

TEST(Cascades, NoCasterIsNearerThanTheMapBegins) {
  const CascadeInputs in = courtyard();
  for (const Cascade& cascade : fit_cascades(in).items) {
    for (float x = -20; x <= 20; x += 5) {
      for (float z = -40; z <= 12; z += 4) {
        const glm::dvec3 p = clip(cascade, {x, 9, z});
        if (std::max(std::abs(p.x), std::abs(p.y)) > 1) continue;
        EXPECT_GE(p.z, 0);
        EXPECT_LE(p.z, 1);
      }
    }
  }
}

TEST(Cascades, TexelsStayPutInTheWorldWhileTheCameraMoves) {
  CascadeInputs in = courtyard();
  const glm::dvec3 point(1.25, 0.5, -3.75);
  glm::dvec2 first{0};
  for (int step = 0; step < 20; ++step) {
    const float s = static_cast<float>(step) * 0.0137f;
    in.view = glm::lookAt(glm::vec3(3 + s, 1.7f, 8 - s), glm::vec3(s, 1, -s), glm::vec3(0, 1, 0));
    const Cascades cascades = fit_cascades(in);
    const glm::dvec2 texel = (glm::dvec2(clip(cascades.items[0], point)) * 0.5 + 0.5) * static_cast<double>(in.size);
    const glm::dvec2 part = texel - glm::floor(texel);
    if (step == 0) first = part;
    const glm::dvec2 moved = glm::abs(part - first);
    EXPECT_LT(std::min(moved.x, 1 - moved.x), 0.01) << "step " << step;
    EXPECT_LT(std::min(moved.y, 1 - moved.y), 0.01) << "step " << step;
  }
}

TEST(Cascades, AJitterMovesTexelsByThatPartOfOneAndLeavesNothingOut) {
  CascadeInputs in = courtyard();
  in.distance = 20;
  const Cascades still = fit_cascades(in);
  for (const glm::dvec2 jitter : {glm::dvec2(0.25, 0.75), {0.999, 0.001}, {0.999, 0.999}}) {
    in.jitter = jitter;
    const Cascades moved = fit_cascades(in);
    for (int i = 0; i < in.count; ++i) {
      const auto& before = still.items.at(static_cast<size_t>(i));
      const auto& after = moved.items.at(static_cast<size_t>(i));
      EXPECT_EQ(before.half_extent, after.half_extent);
      const glm::dvec2 texels = glm::dvec2(after.center - before.center) / glm::dvec2(still.texel(i));
      EXPECT_LT(glm::length(texels - jitter), 1e-2) << "cascade " << i;
    }
    for (const glm::dvec3& point : frustum_points(in, in.distance)) {
      const glm::dvec3 p = clip(moved.items.back(), point);
      EXPECT_LE(std::max(std::abs(p.x), std::abs(p.y)), 1.0);
    }
  }
}

TEST(Cascades, AFarAwayObjectOnTheGroundLeavesNearCascadesTheirDepthRange) {
  CascadeInputs in = courtyard();
  const Cascades near = fit_cascades(in);
  in.casters.max.x = 5000;
  const Cascades far = fit_cascades(in);
  const auto range = [](const Cascade& c) { return c.far_z - c.near_z; };
  EXPECT_LT(range(far.items[0]), 2 * range(near.items[0]));
}

// The greatest depth of the last cascade's map, and the least, are those of the bounds, with a low sun too.
TEST(Cascades, BoundsBelowTheWideOnesAreNotCutOff) {
  for (const float elevation : {5.0f, 30.0f, 90.0f}) {
    CascadeInputs in = courtyard();
    in.to_light = {std::cos(glm::radians(elevation)), std::sin(glm::radians(elevation)), 0};
    in.casters = in.receivers = {{-4000, 0, -4000}, {4000, 3000, 4000}};
    const Cascades cascades = fit_cascades(in);
    in.exact_bounds = true;
    const Cascades exact = fit_cascades(in);
    EXPECT_EQ(cascades.cut_off, CutOff{});
    for (size_t i = 0; i < cascades.items.size(); ++i) {
      EXPECT_EQ(cascades.items[i].world_to_clip, exact.items[i].world_to_clip) << elevation << ", cascade " << i;
    }
  }
}

TEST(Cascades, WideBoundsAreCutOffUnlessTheyAreExact) {
  CascadeInputs in = courtyard();
  in.to_light = {0, 1, 0};
  in.receivers = {{-2e4f, 0, -2e4f}, {2e4f, 9, 2e4f}};
  const auto last = [&] { return fit_cascades(in).items.back(); };
  EXPECT_EQ(fit_cascades(in).cut_off, (CutOff{.view = true, .light = false}));
  EXPECT_LT(last().half_extent.x, 2 * range_in_wide_bounds);
  EXPECT_GT(last().half_extent.x, 0.5 * range_in_wide_bounds);
  in.casters = {{-20, 0, -20}, {20, 1e6f, 20}};
  EXPECT_EQ(fit_cascades(in).cut_off, (CutOff{.view = true, .light = true}));
  EXPECT_LT(last().far_z - last().near_z, 1.5 * wide_bounds);
  in.distance = 15000;
  EXPECT_EQ(fit_cascades(in).cut_off, (CutOff{.view = false, .light = true}));
  EXPECT_GT(last().half_extent.x, 0.5 * in.distance);
  in.distance = 0;
  in.exact_bounds = true;
  EXPECT_EQ(fit_cascades(in).cut_off, CutOff{});
  EXPECT_GT(last().half_extent.x, 1e4);
  EXPECT_GT(last().far_z - last().near_z, 1e6);
}

TEST(Cascades, WideBoundsAreSeenToTenTimesTheDistanceAtWhichTheyBegin) {
  CascadeInputs in = courtyard();
  in.to_light = {0, 1, 0};
  in.view = glm::lookAt(glm::vec3(0, 10, 0), glm::vec3(0, 10, -1), glm::vec3(0, 1, 0));
  for (const auto& [begin, end, cut] : {std::tuple(2000.0f, 19000.0f, false), {2000.0f, 21000.0f, true}}) {
    in.casters = in.receivers = {{-20, 0, -end}, {20, 9, -begin}};
    EXPECT_EQ(fit_cascades(in).cut_off, (CutOff{.view = cut})) << end;
  }
}

TEST(Cascades, WideBoundsAreCutOffBehindAnOrthographicCamera) {
  CascadeInputs in = courtyard();
  in.to_light = {0, 1, 0};
  in.projection = glm::ortho(-30.0f, 30.0f, -30.0f, 30.0f, -20000.0f, 100.0f);
  in.nearest = -20000;
  in.view = glm::lookAt(glm::vec3(0, 5, 0), glm::vec3(0, 5, -1), glm::vec3(0, 1, 0));
  in.casters = in.receivers = {{-20, 0, -10}, {20, 9, 20000}};
  EXPECT_EQ(fit_cascades(in).cut_off, CutOff{.view = true});
  EXPECT_LT(fit_cascades(in).items.back().half_extent.x, range_in_wide_bounds);
}

// Casters that are far below the receivers shadow none of them.
TEST(Cascades, WideBoundsAreLeftOutBelowTheReceivers) {
  CascadeInputs in = courtyard();
  in.to_light = {0, 1, 0};
  const double alone = fit_cascades(in).items.back().far_z;
  in.casters.min.y = -1e6f;
  const Cascades below = fit_cascades(in);
  EXPECT_EQ(below.cut_off, CutOff{});
  EXPECT_LT(below.items.back().far_z, alone + 100);
}

// Of logarithmic ones: the first begins at a thousandth of the whole range, where receivers begin at the camera.
TEST(Cascades, RangesGrowByTheSameRatio) {
  CascadeInputs in = courtyard();
  in.casters = in.receivers = {{-500, 0, -500}, {500, 9, 500}};
  in.distance = 100;
  in.split_blend = 1;
  const std::vector<Cascade> items = fit_cascades(in).items;
  const double ratio = std::pow(1000, 0.25);
  for (size_t i = 2; i < items.size(); ++i) {
    EXPECT_NEAR(items[i].half_extent.x / items[i - 1].half_extent.x, ratio, 0.09 * ratio) << i;
  }
}

// The margin for discs, of all but the last cascade.
TEST(Cascades, FinerOnesAreUpToAQuarterWiderForDiscs) {
  CascadeInputs in = courtyard();
  in.receivers = {{-500, 0, -500}, {500, 9, 500}};
  in.casters = {{-500, 0, -500}, {500, 2000, 500}};
  in.distance = 100;
  in.tan_half_angle = 0;
  const Cascades without = fit_cascades(in);
  in.tan_half_angle = std::tan(glm::radians(5.0f));
  const Cascades with = fit_cascades(in);
  const double rounding = std::exp2(1.0 / 16);  // of the widths, upwards
  for (size_t i = 0; i + 1 < with.items.size(); ++i) {
    const double wider = with.items[i].half_extent.x / without.items[i].half_extent.x;
    EXPECT_GT(wider, 1.25 / rounding) << i;
    EXPECT_LT(wider, 1.25 * rounding) << i;
  }
}

TEST(Cascades, AMapWithNothingOverItHasARange) {
  CascadeInputs in = courtyard();
  in.to_light = {0, 1, 0};
  in.distance = 10;
  in.casters = in.receivers = {{1000, 0, 1000}, {1010, 9, 1010}};
  const Cascades cascades = fit_cascades(in);
  EXPECT_EQ(LightProjection(cascades).fault(), "");
  for (const Cascade& cascade : cascades.items) {
    EXPECT_LT(cascade.near_z, cascade.center.y + 1e4);
    EXPECT_GT(cascade.far_z - cascade.near_z, 0.1f);
    EXPECT_LT(cascade.far_z - cascade.near_z, 1e4f);
  }
}

// As it is before an engine has loaded anything but one object's place.
TEST(Cascades, ReceiversMayBeAPoint) {
  for (const float distance : {0.0f, 5.0f, 1e3f, 1e5f}) {
    CascadeInputs in = courtyard();
    const glm::vec3 point = glm::vec3(3, 1.7f, 8) + distance * glm::normalize(glm::vec3(-3, -0.7f, -8));
    in.receivers = {point, point};
    for (const Box& casters : {in.receivers, in.casters, Box{point + 1.0f, point + 1.0f}}) {
      in.casters = casters;
      const Cascades cascades = fit_cascades(in);
      EXPECT_EQ(LightProjection(cascades).fault(), "") << distance;
      for (const Cascade& cascade : cascades.items) {
        const glm::dvec3 p = clip(cascade, point);
        EXPECT_LT(std::max(std::abs(p.x), std::abs(p.y)), 0.99) << distance;
        EXPECT_GT(p.z, 0) << distance;
        EXPECT_LT(p.z, 1) << distance;
      }
    }
  }
}

TEST(Cascades, TheSunAtTheZenithHasAnAxis) {
  CascadeInputs in = courtyard();
  in.to_light = {0, 1, 0};
  const Cascades cascades = fit_cascades(in);
  const glm::dvec3 down = cascades.world_to_light * glm::dvec3(0, -1, 0);
  EXPECT_NEAR(down.z, 1, 1e-9);
  EXPECT_NEAR(glm::determinant(cascades.world_to_light), -1, 1e-9) << "light space is left-handed";
}

TEST(CullVolume, KeepsWhatCanCastAndDropsTheRest) {
  const CascadeInputs in = courtyard();
  const Cascades cascades = fit_cascades(in);
  const CullVolume volume = cull_volume(cascades, 0);
  const Cascade& cascade = cascades.items[0];
  const glm::dmat3 to_world = glm::transpose(cascades.world_to_light);
  const auto box_at = [&](const glm::dvec3& light_space) {
    const glm::vec3 center(to_world * light_space + cascades.anchor);
    return Box{center - 0.1f, center + 0.1f};
  };
  const double x = cascade.center.x;
  const double y = cascade.center.y;
  const double half = cascade.half_extent.x;
  EXPECT_TRUE(volume.holds(box_at({x, y, cascade.near_z - 50})));
  EXPECT_TRUE(volume.holds(box_at({x + half * 0.99, y, cascade.near_z})));
  EXPECT_FALSE(volume.holds(box_at({x + half + 1, y, cascade.near_z})));
  EXPECT_FALSE(volume.holds(box_at({x, y, cascade.far_z + 1})));
}

}  // namespace
}  // namespace penumbra::shadow

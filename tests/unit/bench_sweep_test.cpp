#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "bench/caster_grid.h"
#include "bench/sweep.h"
#include "core/error.h"
#include "render/renderer.h"
#include "scene/pose.h"

namespace penumbra::test {
namespace {

using bench::make_sweep;
using bench::Point;
using bench::Sweep;

// Figure 4.13: all pairs of four counts.
TEST(Sweep, OfTapsIsTheThesis) {
  const Sweep sweep = make_sweep("taps", {});
  std::set<std::vector<double>> points;
  for (const Point& point : sweep.points) points.insert(point.at);
  EXPECT_EQ(points.size(), 16U);
  for (const double blocker : {8, 32, 64, 128}) {
    for (const double filter : {8, 32, 64, 128}) EXPECT_EQ(points.count({blocker, filter}), 1U);
  }
}

TEST(Sweep, SetsTheParametersOfTheTechnique) {
  const shadow::Registry& registry = shadow::built_in_registry();
  ParamSet params(render::Renderer::params(registry));
  registry.select(params, "brute_force");
  const Sweep sweep = make_sweep("taps", {});
  const ParamSet last = bench::params_at(sweep.points.back(), params);
  EXPECT_EQ(last.get_int("brute_force.blocker_taps"), 128);
  EXPECT_EQ(last.get_int("brute_force.filter_taps"), 128);
  EXPECT_EQ(last.get_int("pcss.filter_taps"), params.get_int("pcss.filter_taps"));
  registry.select(params, "hard");
  EXPECT_THROW(bench::params_at(sweep.points.front(), params), cli::UsageError);
}

TEST(Sweep, EndsWherePatienceDoes) {
  for (const std::string& name : bench::sweep_names()) {
    const Sweep software = make_sweep(name, {.software = true}), gpu = make_sweep(name, {});
    EXPECT_LE(software.points.size(), gpu.points.size()) << name;
    EXPECT_GE(software.points.size(), software.axes.size() + 2) << name;  // enough to fit a model
  }
  EXPECT_EQ(make_sweep("casters", {.software = true}).points.back().triangles, 1'000'000);
  EXPECT_EQ(make_sweep("casters", {}).points.back().triangles, 10'000'000);
}

TEST(Sweep, StaysWithinTheDevicesLimits) {
  for (const Point& point : make_sweep("resolution", {.max_texture = 2048}).points) EXPECT_LE(point.size->width, 2048);
  EXPECT_EQ(make_sweep("map_size", {.max_texture = 2048}).points.back().names.front(), "2048");
  EXPECT_EQ(make_sweep("map_size", {.cascades = 1}).points.back().names.front(), "8192");
}

TEST(Sweep, AnglesAreWrittenAsTheyAreNamed) {
  for (const Point& point : make_sweep("sun_angle", {}).points)
    EXPECT_EQ(fmt::format("{}", point.at.front()), point.names.front());
}

TEST(Sweep, NoSizeComesTwice) {
  const Sweep sweep = make_sweep("resolution", {.size = {1, 1}});
  for (std::size_t i = 1; i < sweep.points.size(); ++i) EXPECT_NE(sweep.points[i].at, sweep.points[i - 1].at) << i;
}

TEST(CasterGrid, HasTheTrianglesThatWereAskedFor) {
  constexpr long long plane = 2;
  for (const long long triangles : {1'000LL, 10'000LL, 100'000LL, 1'000'000LL, 10'000'000LL})
    EXPECT_EQ(bench::drawn_triangles(bench::caster_grid(triangles)), triangles + plane);
}

// The width of the grid does not depend on the number of casters, and they touch the plane.
TEST(CasterGrid, KeepsItsSize) {
  for (const long long triangles : {1'000LL, 100'000LL, 1'000'000LL}) {
    scene::Scene scene = bench::caster_grid(triangles);
    scene.roots = {0};  // without the plane
    const scene::Bounds bounds = scene::bounds_of(scene, scene::rest_pose(scene));
    EXPECT_LE(bounds.extent().x, 20.0F);
    EXPECT_GE(bounds.extent().x, 15.0F) << triangles;
    EXPECT_GE(bounds.min.y, 0.0F);
  }
}

// A turned, scaled parent: copies still lie side by side in the world.
TEST(RepeatedScene, LiesSideBySide) {
  scene::Scene scene;
  scene.meshes = {{.primitives = {{.indices = {0, 1, 2},
                                   .positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
                                   .normals = std::vector<glm::vec3>(3, {0, 1, 0})}}}};
  scene::Node node{.mesh = 0};
  node.transform.rotation = glm::quat(0.8F, 0, 0.6F, 0);
  node.transform.scale = {3, 1, 2};
  scene.nodes = {node};
  scene.roots = {0};
  const glm::vec3 extent = scene::bounds_of(scene, scene::rest_pose(scene)).extent();
  const float side = std::max(extent.x, extent.z);
  const scene::Scene nine = bench::repeated(scene, 9);
  EXPECT_EQ(bench::drawn_triangles(nine), 9);
  const glm::vec3 all = scene::bounds_of(nine, scene::rest_pose(nine)).extent();
  EXPECT_NEAR(all.x, extent.x + 2 * side, 1e-4F);
  EXPECT_NEAR(all.z, extent.z + 2 * side, 1e-4F);
  EXPECT_NEAR(all.y, 0.0F, 1e-5F);
  EXPECT_EQ(bench::drawn_triangles(bench::repeated(scene, 1)), 1);
}

TEST(RepeatedScene, RefusesWhatCannotBeRepeated) { EXPECT_THROW(bench::repeated(scene::Scene{}, 10), Error); }

}  // namespace
}  // namespace penumbra::test

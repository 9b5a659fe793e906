// Penumbrae of lamps against closed forms, and against themselves where they must not depend on how maps are made.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/lamp_scenes.h"

namespace penumbra::test {
namespace {

class LampProfiles : public Lamps {
 protected:
  // The mean over seeds, so that only the bias is left.
  std::vector<double> mean_visibility(const TriangleScene& scene, const shadow::Lamp& lamp, ParamSet params,
                                      int seeds) {
    std::vector<double> mean;
    for (int seed = 0; seed < seeds; ++seed) {
      params.set("sampling.seed", seed);
      const std::vector<float> one = render(scene, lamp, params).visibilities();
      mean.resize(one.size());
      for (size_t i = 0; i < one.size(); ++i) mean[i] += one[i] / seeds;
    }
    return mean;
  }

  // The largest error of a profile.
  double deviation(const Edge& edge, const shadow::Lamp& lamp, const ParamSet& params, int seeds) {
    const TriangleScene scene = scene_of(edge, 64);
    const std::vector<double> mean = mean_visibility(scene, lamp, params, seeds);
    const Shadowed places = render(scene, lamp, params);
    double worst = 0;
    for (size_t i = 0; i < mean.size(); ++i)
      worst = std::max(worst, std::abs(mean[i] - exact_disc(edge.place(glm::dvec3(places.points[i])))));
    return worst;
  }

  // A map of which that many texels cover the penumbra's radius.
  static ParamSet with_texels(ParamSet params, const Edge& edge, double map_tangent, double texels) {
    const double size = 2 * map_tangent * lamp_height * texels / edge.penumbra_radius();
    params.set("lamps.size", static_cast<int>(std::bit_ceil(static_cast<unsigned>(size))));
    return params;
  }
};

const std::vector<Edge>& edges() {
  static const std::vector<Edge> all{{0.5f, 0.05f}, {1, 0.05f},   {1.5f, 0.05f}, {0.5f, 0.1f}, {1, 0.1f},
                                     {1.5f, 0.1f},  {0.5f, 0.2f}, {1, 0.2f},     {1.5f, 0.2f}};
  return all;
}

TEST_F(LampProfiles, BruteForceMatchesTheExactFunctionUnderASpot) {
  for (const Edge& edge : edges()) {
    ParamSet params = with_texels(renderer_->params(), edge, 0.32, 24);
    params.set("technique", std::string("brute_force"));
    params.set("brute_force.every_texel", true);
    EXPECT_LE(deviation(edge, spot(edge.radius, 10), params, 1), 0.02)
        << "lamp of " << edge.radius << " m, caster at " << edge.height << " m";
  }
}

TEST_F(LampProfiles, PcssAndSlicesMatchTheExactFunctionUnderASpot) {
  for (const Edge& edge : edges()) {
    ParamSet params = with_texels(renderer_->params(), edge, 0.32, 24);
    params.set("pcss.blocker_taps", 64);
    params.set("pcss.filter_taps", 64);
    EXPECT_LE(deviation(edge, spot(edge.radius, 10), params, 32), 0.03)
        << "pcss, lamp of " << edge.radius << " m, caster at " << edge.height << " m";
    params.set("technique", std::string("slices"));
    params.set("slices.azimuths", 32);
    params.set("slices.samples", 32);
    EXPECT_LE(deviation(edge, spot(edge.radius, 10), params, 8), 0.02)
        << "slices, lamp of " << edge.radius << " m, caster at " << edge.height << " m";
  }
}

TEST_F(LampProfiles, PenumbraeAwayFromTheAxisMatchTheExactFunction) {
  for (const Edge& edge :
       {Edge{1, 0.2f, 0.9f, 0}, Edge{1, 0.2f, 0, 1.8f}, Edge{1, 0.2f, 0.7f, 1.2f}, Edge{1, 0.2f, 1.4f, 0.8f}}) {
    ParamSet params = renderer_->params();
    params.set("lamps.size", 1600);
    params.set("technique", std::string("brute_force"));
    params.set("brute_force.every_texel", true);
    EXPECT_LE(deviation(edge, point_lamp(edge.radius), params, 1), 0.02) << "edge at " << edge.x << ", z " << edge.z;
    params.set("technique", std::string("slices"));
    params.set("slices.azimuths", 32);
    params.set("slices.samples", 32);
    EXPECT_LE(deviation(edge, point_lamp(edge.radius), params, 8), 0.02) << "edge at " << edge.x << ", z " << edge.z;
  }
}

TEST_F(LampProfiles, TheNormalOffsetIsThatOfTheWorldAwayFromTheAxis) {
  constexpr float offset = 8;
  const Edge edge{1, 0, 1.4f, 0.8f};
  const TriangleScene scene = scene_of(Edge{1, 0.4f, 1.4f, 0.8f}, 64);
  ParamSet params = renderer_->params();
  params.set("technique", std::string("hard"));
  params.set("lamps.size", 256);
  params.set("bias.normal_offset", offset);
  const float texel = 2 * lamp_height / 256 / (1 - 16.0f / 256);
  const Shadowed shadowed = render(scene, point_lamp(0), params);
  int lit = 0, dark = 0;
  for (size_t i = 0; i < shadowed.points.size(); ++i) {
    const glm::vec3& point = shadowed.points[i];
    const float across = glm::length(glm::vec2(point.x, point.z));
    const float raised = offset * texel * across / std::hypot(across, lamp_height);
    const float from_edge = point.x * lamp_height / (lamp_height - raised) - edge.shadow_x();
    if (std::abs(from_edge) < 1.5f * texel) continue;
    ASSERT_EQ(shadowed.mask[4 * i], from_edge > 0 ? 1.0f : 0.0f) << from_edge << " m from the edge";
    ++(from_edge > 0 ? lit : dark);
  }
  EXPECT_GT(lit, 20);
  EXPECT_GT(dark, 20);
}

TEST_F(LampProfiles, TechniquesAndDriversAgree) {
  const Edge edge{1, 0.05f, 0.5f, 0.4f};
  const TriangleScene scene = scene_of(edge, 64);
  for (const shadow::Technique& technique : renderer_->shadows().registry().techniques()) {
    if (technique.suns_only || technique.name == "none") continue;
    for (const shadow::Lamp& lamp : {point_lamp(edge.radius), spot(edge.radius, 40)}) {
      ParamSet params = renderer_->params();
      params.set("technique", technique.name);
      params.set("lamps.size", 512);
      const Shadowed fragment = render(scene, lamp, params);
      params.set("driver", std::string("compute"));
      const Shadowed compute = render(scene, lamp, params);
      for (size_t i = 0; i < fragment.points.size(); ++i) {
        ASSERT_NEAR(fragment.mask[4 * i], compute.mask[4 * i], 2e-3) << technique.name;
        const double place = edge.place(glm::dvec3(fragment.points[i]));
        const float visibility = fragment.mask[4 * i];
        const bool expected = place < -1.0 ? visibility <= 0.6f : place < 1.0 || visibility >= 0.4f;
        ASSERT_TRUE(expected) << technique.name << ": " << visibility << " at " << place;
      }
    }
  }
}

TEST_F(LampProfiles, SoftnessDependsOnNeitherMapSizeNorNearPlane) {
  const Edge edge{1, 0.1f, 0.4f, 0.3f};
  TriangleScene scene = scene_of(edge, 96);
  // A caster at the lamp's height, so that only lamps.near says where the near plane is.
  scene.add_quad({3, lamp_height - 0.5f, -4}, {0, 1, 0}, {1, 0, 0});
  ParamSet params = renderer_->params();
  params.set("technique", std::string("slices"));
  params.set("slices.azimuths", 32);
  params.set("slices.samples", 32);
  const auto width = [&] {
    const std::vector<double> mean = mean_visibility(scene, point_lamp(edge.radius), params, 4);
    return width_10_90(std::vector<double>(mean.begin(), mean.begin() + scene.width), 1.0);
  };
  params.set("lamps.size", 4096);
  const double fine = width();
  for (const int size : {1024, 2048}) {
    params.set("lamps.size", size);
    EXPECT_NEAR(width(), fine, 0.03 * fine) << size << " texels";
  }
  for (const float near : {0.001f, 0.1f, 0.5f}) {
    params.set("lamps.near", near);
    EXPECT_NEAR(width(), fine, 0.03 * fine) << "near plane at " << near << " m";
  }
}

}  // namespace
}  // namespace penumbra::test

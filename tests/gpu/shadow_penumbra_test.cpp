// Penumbrae against closed forms and against themselves: their width must not depend on how the maps are made.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <utility>
#include <vector>

#include "gpu/exact_penumbra.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

// A half-plane x < 0 at a height above the plane y = 0, with a camera between the two. Receivers extend 2.5 penumbra
// radii to each side of the edge.
TriangleScene knife_edge(float height, float angle_degrees, int width) {
  const float radius = height * std::tan(glm::radians(angle_degrees) / 2);
  const float reach = 2.5f * radius;
  TriangleScene scene;
  scene.add_quad({-reach, 0, -reach}, {0, 0, 2 * reach}, {2 * reach, 0, 0});
  scene.add_quad({-20 * reach, height, -20 * reach}, {0, 0, 40 * reach}, {20 * reach, 0, 0});
  scene.receivers = shadow::Box{{-reach, 0, -reach}, {reach, 0, reach}};
  scene.width = width;
  scene.height = 4;
  scene.view = glm::lookAt(glm::vec3(0, height / 2, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection =
      orthographic(1.25f * radius, 1.25f * radius * 4 / static_cast<float>(width), 0.01f * height, height);
  return scene;
}

// The largest error of a profile, and where it is.
struct Deviation {
  double worst = 0;
  double at = 0;
};

template <class Profile>
Deviation deviation(const Shadowed& shadowed, float radius, Profile exact) {
  Deviation result;
  for (int y = 0; y < shadowed.height; ++y) {
    for (int x = 0; x < shadowed.width; ++x) {
      const double t = shadowed.point(x, y).x / radius;
      const double error = std::abs(shadowed.visibility(x, y) - exact(t));
      if (error > result.worst) result = {error, t};
    }
  }
  return result;
}

struct Case {
  float height, angle;
};
constexpr Case cases[] = {{1, 0.53f}, {5, 0.53f}, {20, 0.53f}, {1, 2}, {5, 2}, {20, 2}, {1, 8}, {5, 8}, {20, 8}};

class KnifeEdge : public TriangleTest {
 protected:
  static ParamSet parameters(TriangleRenderer& renderer, float angle, const std::string& shape) {
    ParamSet params = renderer.params();
    params.set("sun.angle", angle);
    params.set("sun.shape", shape);
    params.set("cascades.count", 1);
    params.set("cascades.size", 256);
    return params;
  }
  static void expect_wide_kernel(const TriangleRenderer& renderer, float radius) {
    ASSERT_GE(radius / renderer.mask().lights[0].projection.cascades().texel(0).x, 24) << "the case is framed too wide";
  }
};

TEST_F(KnifeEdge, BruteForceWithEveryTexelMatchesTheExactFunction) {
  for (const std::string shape : {"disc", "square"}) {
    for (const Case& c : cases) {
      ParamSet params = parameters(*renderer_, c.angle, shape);
      params.set("technique", std::string("brute_force"));
      params.set("brute_force.every_texel", true);
      const float radius = c.height * std::tan(glm::radians(c.angle) / 2);
      const Shadowed shadowed = renderer_->render(knife_edge(c.height, c.angle, 128), params);
      expect_wide_kernel(*renderer_, radius);
      const Deviation d = deviation(shadowed, radius, shape == "disc" ? exact_disc : exact_square);
      EXPECT_LE(d.worst, 0.02) << shape << " sun of " << c.angle << " degrees, caster at " << c.height
                               << " m, t = " << d.at;
    }
  }
}

TEST_F(KnifeEdge, PcssAveragedOverRotationsMatchesTheExactFunction) {
  for (const auto& [shape, reads] :
       {std::pair<std::string, std::string>("disc", "footprint"), {"disc", "texel"}, {"square", "footprint"}}) {
    for (const Case& c : cases) {
      ParamSet params = parameters(*renderer_, c.angle, shape);
      params.set("pcss.blocker_reads", reads);
      params.set("pcss.blocker_taps", 64);
      params.set("pcss.filter_taps", 64);
      const float radius = c.height * std::tan(glm::radians(c.angle) / 2);
      const TriangleScene scene = knife_edge(c.height, c.angle, 64);
      Shadowed mean = renderer_->render(scene, params);
      for (int seed = 1; seed < 64; ++seed) {
        params.set("sampling.seed", seed);
        const Shadowed one = renderer_->render(scene, params);
        for (size_t i = 0; i < mean.mask.size(); ++i) mean.mask[i] += one.mask[i];
      }
      for (float& value : mean.mask) value /= 64;
      expect_wide_kernel(*renderer_, radius);
      const Deviation d = deviation(mean, radius, shape == "disc" ? exact_disc : exact_square);
      EXPECT_LE(d.worst, 0.03) << reads << ", " << shape << " sun of " << c.angle << " degrees, caster at " << c.height
                               << " m, t = " << d.at;
    }
  }
}

// The mean of pictures with as many seeds.
Shadowed mean_of_seeds(TriangleRenderer& renderer, const TriangleScene& scene, ParamSet params, int seeds) {
  Shadowed mean = renderer.render(scene, params);
  for (int seed = 1; seed < seeds; ++seed) {
    params.set("sampling.seed", seed);
    const Shadowed one = renderer.render(scene, params);
    for (size_t i = 0; i < mean.mask.size(); ++i) mean.mask[i] += one.mask[i];
  }
  for (float& value : mean.mask) value /= static_cast<float>(seeds);
  return mean;
}

// Techniques that integrate over the light itself, with many samples.
struct Integrating {
  const char* technique;
  double slit;  // greatest error where two heights meet: of cells that are larger than texels, each edge is random
  std::vector<std::pair<const char*, int>> fine;

  void choose(ParamSet& params) const {
    params.set("technique", std::string(technique));
    for (const auto& [name, value] : fine) params.set(name, value);
  }
};
const std::vector<Integrating>& integrating() {
  static const std::vector<Integrating> all{{"slices", 0.02, {{"slices.azimuths", 32}, {"slices.samples", 32}}},
                                            {"backprojection", 0.04, {{"backprojection.reads", 29}}}};
  return all;
}

TEST_F(KnifeEdge, SlicesAndBackprojectionMatchTheExactFunction) {
  for (const Integrating& fine : integrating()) {
    for (const std::string shape : {"disc", "square"}) {
      for (const Case& c : cases) {
        ParamSet params = parameters(*renderer_, c.angle, shape);
        fine.choose(params);
        const float radius = c.height * std::tan(glm::radians(c.angle) / 2);
        const Shadowed mean = mean_of_seeds(*renderer_, knife_edge(c.height, c.angle, 64), params, 16);
        expect_wide_kernel(*renderer_, radius);
        const Deviation d = deviation(mean, radius, shape == "disc" ? exact_disc : exact_square);
        EXPECT_LE(d.worst, 0.02) << fine.technique << ", " << shape << " sun of " << c.angle << " degrees, caster at "
                                 << c.height << " m, t = " << d.at;
      }
    }
  }
}

// One surface above another is the case in which means and variances say all. The filter is a square, also for a disc.
TEST_F(KnifeEdge, VssmWidensWithTheCastersHeight) {
  for (const std::string shape : {"disc", "square"}) {
    for (const Case& c : cases) {
      ParamSet params = parameters(*renderer_, c.angle, shape);
      params.set("technique", std::string("vssm"));
      const float radius = c.height * std::tan(glm::radians(c.angle) / 2);
      const Shadowed shadowed = renderer_->render(knife_edge(c.height, c.angle, 128), params);
      expect_wide_kernel(*renderer_, radius);
      const Deviation d = deviation(shadowed, radius, shape == "disc" ? exact_disc : exact_square);
      std::printf("vssm, %s, %.2f degrees, %.0f m: off by %.3f at %.2f\n", shape.c_str(), static_cast<double>(c.angle),
                  static_cast<double>(c.height), d.worst, d.at);
      EXPECT_LE(d.worst, shape == "disc" ? 0.03 : 0.005)
          << shape << " sun of " << c.angle << " degrees, caster at " << c.height << " m, t = " << d.at;
    }
  }
}

// Half-planes on both sides of a slit, the right one four times as high as the left. What each of them hides of the sun
// is exact; with one mean height for both, the error is more than a tenth.
TEST_F(KnifeEdge, BlockersAtTwoHeightsAddUpAsTheyShould) {
  constexpr float angle = 2, low = 5, high = 20;
  const float slope = std::tan(glm::radians(angle) / 2);
  const float slit = 2 * low * slope;
  TriangleScene scene = knife_edge(low, angle, 64);
  scene.add_quad({slit, high, -4}, {0, 0, 8}, {4, 0, 0});
  const auto exact = [&](double t) {
    const double right = static_cast<double>(slit) / static_cast<double>(low * slope) - t;
    return std::max(exact_disc(right * static_cast<double>(low / high)) - exact_disc(-t), 0.0);
  };
  ParamSet params = parameters(*renderer_, angle, "disc");
  for (const Integrating& fine : integrating()) {
    fine.choose(params);
    const Deviation d = deviation(mean_of_seeds(*renderer_, scene, params, 16), low * slope, exact);
    EXPECT_LE(d.worst, fine.slit) << fine.technique << ", t = " << d.at;
  }
  params.set("technique", std::string("brute_force"));
  EXPECT_GE(deviation(renderer_->render(scene, params), low * slope, exact).worst, 0.1);
}

// PCSS assumes that blockers are parallel to the light's disc, so its penumbra has an error under an oblique sun. The
// test bounds it.
TEST_F(KnifeEdge, ObliqueSunsAreOffByNoMoreThanPcssItselfIs) {
  struct Oblique {
    double angle, elevation, bound;
  };
  const double height = 5;
  for (const auto& [angle, elevation, bound] : {Oblique{2, 60, 0.01}, {2, 30, 0.015}, {8, 60, 0.015}, {8, 30, 0.04}}) {
    const double tan_half = std::tan(glm::radians(angle) / 2);
    for (const double azimuth : {0.0, 45.0, 90.0}) {
      const glm::dvec3 to_light(sun_direction(static_cast<float>(azimuth), static_cast<float>(elevation)));
      // Receivers whose ray to the sun's centre meets the edge: the middle of the penumbra.
      const double middle = -height * to_light.x / to_light.y;
      const double half = 1.6 * height * tan_half / (to_light.y * to_light.y);
      TriangleScene scene = knife_edge(static_cast<float>(height), static_cast<float>(angle), 192);
      scene.triangles.clear();
      scene.add_quad({-60, 0, -60}, {0, 0, 120}, {120, 0, 0});
      scene.add_quad({-60, static_cast<float>(height), -60}, {0, 0, 120}, {60, 0, 0});
      const auto at = static_cast<float>(middle);
      const auto reach = static_cast<float>(half);
      scene.receivers = shadow::Box{{at - reach, 0, -reach}, {at + reach, 0, reach}};
      scene.to_light = glm::vec3(to_light);
      scene.view = glm::lookAt(glm::vec3(at, height / 2, 0), glm::vec3(at, 0, 0), glm::vec3(0, 0, -1));
      scene.projection = orthographic(reach, 0.02f * reach, 0.1f, 4);
      ParamSet params = parameters(*renderer_, static_cast<float>(angle), "disc");
      params.set("technique", std::string("brute_force"));
      params.set("brute_force.every_texel", true);
      const Shadowed shadowed = renderer_->render(scene, params);
      double worst = 0;
      double width = 0;
      for (int x = 0; x < shadowed.width; ++x) {
        const double exact = exact_oblique(to_light, shadowed.point(x, 2).x, height, tan_half);
        worst = std::max(worst, std::abs(shadowed.visibility(x, 2) - exact));
        width += exact > 0.1 && exact < 0.9 ? 1 : 0;
      }
      std::printf("sun of %.0f degrees at %.0f degrees, azimuth %.0f degrees to the edge: off by %.3f\n", angle,
                  elevation, azimuth, worst);
      EXPECT_GT(width, 20) << "the penumbra is not in the picture";
      EXPECT_LE(worst, bound);
    }
  }
}

// The width of the knife edge's penumbra under a sun of 8 degrees, `distance` metres from a camera that sees the plane
// in perspective along the edge, so that the cascade depends on the distance. The profile is a mean over many rows.
double width_at(TriangleRenderer& renderer, int cascades, int size, bool far_object, float distance,
                double* kernel_texels) {
  const float height = 4;
  const float angle = 8;
  const float radius = height * std::tan(glm::radians(angle) / 2);
  TriangleScene scene;
  scene.add_quad({-25, 0, -40}, {0, 0, 45}, {50, 0, 0});
  scene.add_quad({-25, height, -40}, {0, 0, 45}, {25, 0, 0});
  if (far_object) scene.add_box({400, 0, -900}, {420, 60, -880});
  scene.width = 192;
  scene.height = 224;
  // The camera is below the caster and looks down at the edge's shadow; its picture covers the penumbra.
  const glm::vec3 eye{0, 2, 4};
  const glm::vec3 target{0, 0, 4 - distance};
  scene.view = glm::lookAt(eye, target, glm::vec3(0, 1, 0));
  const float fov = 2 * std::atan(1.3f * radius / glm::length(target - eye));
  scene.projection = perspective(fov, static_cast<float>(scene.width) / static_cast<float>(scene.height), 0.1f);
  ParamSet params = renderer.params();
  params.set("technique", std::string("pcss"));
  params.set("pcss.blocker_taps", 64);
  params.set("pcss.filter_taps", 64);
  params.set("sun.angle", angle);
  params.set("cascades.count", cascades);
  params.set("cascades.size", size);
  const Shadowed shadowed = renderer.render(scene, params);
  const int bins = 96;
  std::vector<double> sum(bins, 0.0), count(bins, 0.0);
  int coarsest = 0;
  for (int y = 0; y < shadowed.height; ++y) {
    for (int x = 0; x < shadowed.width; ++x) {
      if (shadowed.sky(x, y)) continue;
      const double t = shadowed.point(x, y).x / radius;
      const int bin = static_cast<int>(std::floor((t + 1.2) / 2.4 * bins));
      if (bin < 0 || bin >= bins) continue;
      sum[static_cast<size_t>(bin)] += shadowed.visibility(x, y);
      count[static_cast<size_t>(bin)] += 1;
      coarsest =
          std::max(coarsest, static_cast<int>(shadowed.mask[4 * static_cast<size_t>(y * shadowed.width + x) + 3]));
    }
  }
  *kernel_texels = radius / renderer.mask().lights[0].projection.cascades().texel(coarsest).x;
  std::vector<double> profile;
  for (size_t i = 0; i < sum.size(); ++i) profile.push_back(count[i] > 0 ? sum[i] / count[i] : std::nan(""));
  return width_10_90(profile, 2.4 * radius / bins);
}

using PenumbraWidth = TriangleTest;

TEST_F(PenumbraWidth, IsTheSameForEveryCascadeCountMapSizeAndBounds) {
  int qualified = 0;
  int all = 0;
  for (const float distance : {4.0f, 12.0f, 24.0f}) {
    double least = 1e9;
    double greatest = 0;
    for (const int cascades : {1, 2, 4, 8}) {
      for (const int size : {1024, 2048, 3072}) {
        if (cascades == 8 && size == 3072) continue;  // would take half as long as all others
        for (const bool far_object : {false, true}) {
          double texels = 0;
          const double width = width_at(*renderer_, cascades, size, far_object, distance, &texels);
          ++all;
          if (texels < 4) continue;
          ++qualified;
          ASSERT_TRUE(std::isfinite(width)) << cascades << " cascades of " << size << " at " << distance << " m";
          least = std::min(least, width);
          greatest = std::max(greatest, width);
        }
      }
    }
    EXPECT_LE(greatest / least, 1.03) << "at " << distance << " m: from " << least << " to " << greatest;
  }
  EXPECT_GE(2 * qualified, all) << "too few cases have a kernel of 4 texels";
}

}  // namespace
}  // namespace penumbra::test

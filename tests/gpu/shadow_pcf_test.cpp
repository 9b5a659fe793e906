// Percentage-closer filters of constant width against the closed forms of a straight edge.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr double pi = 3.14159265358979323846;

struct Sample {
  double at = 0;  // metres across the edge, growing towards the lit side
  double visibility = 0;
};

class PcfTest : public TriangleTest {
 protected:
  ParamSet parameters(const std::string& technique) const {
    ParamSet params = renderer_->params();
    params.set("technique", technique);
    params.set("cascades.count", 1);
    params.set("cascades.size", 256);
    return params;
  }
  double texel() const { return static_cast<double>(renderer_->mask().lights[0].projection.cascades().texel(0).x); }

  // The ground below a half-plane's edge, which runs along texels of the map, out to so many metres on each side.
  static TriangleScene edge(float reach, int width) {
    TriangleScene scene = half_plane_over_ground(width);
    scene.height = 4;
    scene.projection = orthographic(reach, reach * 4 / static_cast<float>(width), 0.1f, 5);
    return scene;
  }
  static std::vector<Sample> profile(const Shadowed& shadowed) {
    std::vector<Sample> samples;
    for (int x = 0; x < shadowed.width; ++x)
      samples.push_back({static_cast<double>(shadowed.point(x, 1).x), static_cast<double>(shadowed.visibility(x, 1))});
    std::ranges::sort(samples, {}, &Sample::at);
    return samples;
  }
  // Where the visibility is one half: the map's edge lies between two texels, up to half a texel from the caster's.
  static double middle(const std::vector<Sample>& samples) {
    for (size_t i = 1; i < samples.size(); ++i) {
      const Sample &a = samples[i - 1], &b = samples[i];
      if (a.visibility < 0.5 && b.visibility >= 0.5)
        return a.at + (b.at - a.at) * (0.5 - a.visibility) / (b.visibility - a.visibility);
    }
    ADD_FAILURE() << "no edge";
    return 0;
  }
  template <class Profile>
  static double worst(const std::vector<Sample>& samples, Profile exact) {
    const double edge_at = middle(samples);
    double result = 0;
    for (const Sample& sample : samples)
      result = std::max(result, std::abs(sample.visibility - exact(sample.at - edge_at)));
    return result;
  }
};

TEST_F(PcfTest, TheHardwareFilterIsARampOneTexelWide) {
  const std::vector<Sample> samples = profile(renderer_->render(edge(0.1f, 512), parameters("pcf_hardware")));
  const double width = texel();
  EXPECT_LE(worst(samples, [&](double x) { return std::clamp(0.5 + x / width, 0.0, 1.0); }), 0.02);
}

TEST_F(PcfTest, ATentIsTheIntegralOfATentOfItsWidthInTexels) {
  for (const int width : {3, 4, 5, 7}) {
    ParamSet params = parameters("pcf_tent");
    params.set("pcf_tent.width", width);
    const std::vector<Sample> samples = profile(renderer_->render(edge(0.2f, 512), params));
    const double radius = 0.5 * width * texel();
    const auto exact = [&](double x) {
      const double t = std::clamp(x / radius, -1.0, 1.0);
      return 0.5 + t * (1 - 0.5 * std::abs(t));
    };
    EXPECT_LE(worst(samples, exact), 0.005) << "a tent of " << width << " texels";
  }
}

TEST_F(PcfTest, APoissonDiscAveragedOverRotationsIsADiscInMetres) {
  constexpr int seeds = 64;
  constexpr float radius = 0.25f;
  for (const int size : {256, 512}) {
    ParamSet params = parameters("pcf_poisson");
    params.set("cascades.size", size);
    params.set("pcf_poisson.radius", radius);
    params.set("pcf_poisson.taps", 64);
    std::vector<Sample> mean;
    for (int seed = 0; seed < seeds; ++seed) {
      params.set("sampling.seed", seed);
      const std::vector<Sample> one = profile(renderer_->render(edge(0.7f, 192), params));
      if (mean.empty()) mean.resize(one.size());
      for (size_t i = 0; i < one.size(); ++i) {
        mean[i].at = one[i].at;
        mean[i].visibility += one[i].visibility / seeds;
      }
    }
    ASSERT_GE(radius / texel(), 10) << "the disc is framed too narrow";
    // The map ends where the picture does.
    std::erase_if(mean, [](const Sample& sample) { return std::abs(sample.at) > 1.1 * static_cast<double>(radius); });
    const auto exact = [](double x) {
      const double t = std::clamp(x / static_cast<double>(radius), -1.0, 1.0);
      return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / pi;
    };
    EXPECT_LE(worst(mean, exact), 0.02) << "a map of " << size << " texels";
  }
}

// A fetch compares four texels with one depth, so on a steep receiver it misses casters that are nearer to it than its
// plane falls across them; gathers compare each texel with the plane at its centre.
TEST_F(PcfTest, AGatherSeesALowCasterOverASteepReceiverThatTheHardwareMisses) {
  TriangleScene scene;
  scene.add_quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0});
  scene.add_quad({-2, 0.004f, -2}, {0, 0, 4}, {2, 0, 0});  // over half of the ground
  scene.to_light = sun_direction(270, 10);
  scene.width = 256;
  scene.height = 4;
  scene.view = glm::lookAt(glm::vec3(-0.8f, 0.002f, 0), glm::vec3(-0.8f, 0, 0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(0.8f, 0.8f * 4 / 256, 0.0005f, 0.1f);
  const auto mean = [&](const std::string& technique) {
    const Shadowed shadowed = renderer_->render(scene, parameters(technique));
    double sum = 0;
    for (int x = 0; x < shadowed.width; ++x) sum += static_cast<double>(shadowed.visibility(x, 1)) / shadowed.width;
    return sum;
  };
  EXPECT_LE(mean("hard"), 0.05);
  EXPECT_GE(mean("pcf_hardware"), 0.3);
}

}  // namespace
}  // namespace penumbra::test

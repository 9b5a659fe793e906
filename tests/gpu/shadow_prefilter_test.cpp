// Techniques that filter a map before it is compared (vsm, evsm, msm, esm, csm_fourier), against the closed form of a
// straight edge under their kernel, and in the cases that their authors name as failures.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "gpu/triangle_scene.h"
#include "support/alike.h"

namespace penumbra::test {
namespace {

constexpr float radius = 0.25f;

const std::vector<std::string>& techniques() {
  static const std::vector<std::string> names{"vsm", "evsm", "msm", "esm", "csm_fourier"};
  return names;
}

class PrefilterTest : public TriangleTest {
 protected:
  ParamSet parameters(const std::string& technique) const {
    ParamSet params = renderer_->params();
    params.set("technique", technique);
    params.set("cascades.count", 1);
    params.set("cascades.size", 512);
    if (params.contains(technique + ".radius")) params.set(technique + ".radius", radius);
    if (params.contains(technique + ".bleeding")) params.set(technique + ".bleeding", 0.0f);
    return params;
  }
};

// Share of the kernel that lies at or beyond so many radii from its centre, along an axis.
double kernel_beyond(double at) {
  const auto weight = [](double t) { return std::max(std::exp(-2 * t * t) - std::exp(-2.0), 0.0); };
  constexpr int steps = 2000;
  double beyond = 0, all = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = -1 + (i + 0.5) * 2 / steps;
    all += weight(t);
    if (t >= at) beyond += weight(t);
  }
  return beyond / all;
}

TEST_F(PrefilterTest, AnEdgeIsTheIntegralOfTheKernelInMetres) {
  for (const std::string& technique : techniques()) {
    for (const int shrink : {1, 2}) {
      ParamSet params = parameters(technique);
      params.set(technique + ".shrink", shrink);
      TriangleScene scene = half_plane_over_ground(256);
      scene.height = 4;
      scene.projection = orthographic(0.7f, 0.7f * 4 / 256, 0.1f, 5);
      const Shadowed shadowed = renderer_->render(scene, params);
      double worst = 0;
      for (int x = 0; x < shadowed.width; ++x) {
        const auto at = static_cast<double>(shadowed.point(x, 1).x / radius);
        if (std::abs(at) > 1.5) continue;
        worst = std::max(worst, std::abs(static_cast<double>(shadowed.visibility(x, 1)) - kernel_beyond(-at)));
      }
      // The series of 16 terms does not reach the ends of its range.
      EXPECT_LE(worst, technique == "csm_fourier" ? 0.06 : 0.03) << technique << ", shrink " << shrink;
    }
  }
}

TEST_F(PrefilterTest, SixteenBitsGiveTheSameEdge) {
  for (const auto& [technique, format] : {std::pair{"msm", "unorm16"}, {"evsm", "float16"}}) {
    ParamSet params = parameters(technique);
    TriangleScene scene = half_plane_over_ground(256);
    scene.height = 4;
    scene.projection = orthographic(0.7f, 0.7f * 4 / 256, 0.1f, 5);
    const Shadowed full = renderer_->render(scene, params);
    params.set(fmt::format("{}.format", technique), std::string(format));
    const Shadowed half = renderer_->render(scene, params);
    double worst = 0;
    for (int x = 0; x < full.width; ++x)
      worst = std::max(worst, std::abs(static_cast<double>(full.visibility(x, 1) - half.visibility(x, 1))));
    EXPECT_LE(worst, 0.06) << technique;
    EXPECT_GT(worst, 0) << technique << ": the format changes nothing";
  }
}

// At the higher caster's edge the kernel holds both casters' depths. Their variance leaves light on what lies below
// both.
TEST_F(PrefilterTest, LightBleedsWhereTwoCastersLieAboveEachOther) {
  const auto below = [&](const std::string& technique) {
    TriangleScene scene;
    scene.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
    scene.add_quad({-4, 4, -4}, {0, 0, 8}, {4, 0, 0});  // high, over the left half
    scene.add_quad({-4, 1, -4}, {0, 0, 8}, {8, 0, 0});  // low, over everything
    scene.width = 128;
    scene.height = 4;
    scene.view = glm::lookAt(glm::vec3(0, 0.5f, 0), glm::vec3(0), glm::vec3(0, 0, -1));
    scene.projection = orthographic(0.2f, 0.2f * 4 / 128, 0.1f, 2);
    const Shadowed shadowed = renderer_->render(scene, parameters(technique));
    double most = 0;
    for (int x = 0; x < shadowed.width; ++x) most = std::max(most, static_cast<double>(shadowed.visibility(x, 1)));
    return most;
  };
  EXPECT_GT(below("vsm"), 0.3);
  EXPECT_LE(below("evsm"), 0.05);
  EXPECT_LE(below("msm"), 0.05);
  EXPECT_LE(below("esm"), 0.05);
}

TEST_F(PrefilterTest, FullShadowIsDarkBelowOneCaster) {
  for (const std::string& technique : techniques()) {
    TriangleScene scene = half_plane_over_ground(64);
    scene.projection = orthographic(1.5f, 1.5f, 0.1f, 5);
    const Shadowed shadowed = renderer_->render(scene, parameters(technique));
    float most = 0;
    for (int x = 0; x < shadowed.width; ++x)
      if (shadowed.point(x, 32).x < -2 * radius) most = std::max(most, shadowed.visibility(x, 32));
    EXPECT_LE(most, 0.02f) << technique;
  }
}

TEST_F(PrefilterTest, LitPlanesDoNotShadowThemselves) {
  for (const std::string& technique : techniques()) {
    ParamSet params = parameters(technique);
    if (params.contains(technique + ".plane_bias")) params.set(technique + ".plane_bias", 1.8f);
    for (const float elevation : {10.0f, 30.0f, 60.0f, 90.0f}) {
      TriangleScene scene;
      scene.add_quad({-4, 0, -4}, {0, 1, 8}, {8, 0.5f, 0});
      scene.to_light = sun_direction(35, elevation);
      scene.view = glm::lookAt(glm::vec3(0, 3, 4), glm::vec3(0), glm::vec3(0, 1, 0));
      scene.projection = perspective(0.8f, 1, 0.1f);
      const Shadowed shadowed = renderer_->render(scene, params);
      int receivers = 0, dark = 0;
      for (int y = 0; y < scene.height; ++y) {
        for (int x = 0; x < scene.width; ++x) {
          // The map ends where the plane does.
          const glm::vec3 at = glm::abs(shadowed.point(x, y));
          if (shadowed.sky(x, y) || std::max(at.x, at.z) > 3) continue;
          ++receivers;
          dark += shadowed.visibility(x, y) < 0.9f ? 1 : 0;
        }
      }
      ASSERT_GT(receivers, 500);
      EXPECT_LE(dark, receivers / 1000) << technique << ", sun at " << elevation << " degrees";
    }
  }
}

// Levels of a filtered map differ from pixel to pixel, which drivers shade in groups.
TEST_F(PrefilterTest, FragmentAndComputeGiveTheSameMask) {
  TriangleScene scene;
  scene.add_quad({-60, 0, -60}, {0, 0, 120}, {120, 0, 0});
  for (int i = 0; i < 7; ++i) {
    const auto x = static_cast<float>(2 * i - 6);
    scene.add_box({x, 0, -2 - x}, {x + 0.6f, 0.4f + 0.5f * static_cast<float>(i), -1 - x});
  }
  scene.to_light = sun_direction(60, 35);
  scene.width = 160;
  scene.height = 90;
  scene.view = glm::lookAt(glm::vec3(1, 3, 8), glm::vec3(0, 0.5f, 0), glm::vec3(0, 1, 0));
  scene.projection = perspective(0.95f, 16.0f / 9.0f, 0.1f);
  std::vector<std::string> names = techniques();
  names.emplace_back("cssm");
  for (const std::string& technique : names) {
    ParamSet params = parameters(technique);
    params.set("cascades.count", 3);
    params.set("sun.angle", 2.0f);
    if (params.contains(technique + ".radius")) params.set(technique + ".radius", 0.08f);
    const Shadowed fragment = renderer_->render(scene, params);
    params.set("driver", std::string("compute"));
    SCOPED_TRACE(technique);
    expect_same_visibility(fragment.visibilities(), renderer_->render(scene, params).visibilities(), 16);
  }
}

// Far from the camera a pixel is wider than the kernel: coarser levels widen it, instead of leaving aliases.
TEST_F(PrefilterTest, DistantShadowsAreFilteredOverThePixel) {
  TriangleScene scene;
  scene.add_quad({-20, 0, -20}, {0, 0, 40}, {40, 0, 0});
  for (int i = 0; i < 200; ++i) {
    const float x = -20 + 0.2f * static_cast<float>(i);
    scene.add_quad({x, 2, -20}, {0, 0, 40}, {0.1f, 0, 0});  // a fence over half of the ground
  }
  scene.width = scene.height = 32;
  scene.view = glm::lookAt(glm::vec3(0, 1, 0), glm::vec3(0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(10, 10, 0.1f, 2);  // a pixel is 0.6 m wide
  for (const std::string& technique : techniques()) {
    ParamSet params = parameters(technique);
    params.set("cascades.size", 1024);
    params.set(technique + ".radius", 0.0f);
    const Shadowed shadowed = renderer_->render(scene, params);
    float least = 1, most = 0;
    for (int y = 8; y < 24; ++y) {
      for (int x = 8; x < 24; ++x) {
        least = std::min(least, shadowed.visibility(x, y));
        most = std::max(most, shadowed.visibility(x, y));
      }
    }
    EXPECT_GE(least, 0.35f) << technique;
    EXPECT_LE(most, 0.65f) << technique;
  }
}

// Metres between the places where a tenth and nine tenths of the light are visible.
double width_of(const Shadowed& shadowed) {
  double from = 0, to = 0;
  for (int x = 1; x < shadowed.width; ++x) {
    const auto at = [&](double level) {
      const double a = shadowed.visibility(x - 1, 1), b = shadowed.visibility(x, 1);
      const double share = (level - a) / (b - a);
      return static_cast<double>(shadowed.point(x - 1, 1).x) +
             share * static_cast<double>(shadowed.point(x, 1).x - shadowed.point(x - 1, 1).x);
    };
    const float before = shadowed.visibility(x - 1, 1), after = shadowed.visibility(x, 1);
    if (before < 0.1f && after >= 0.1f) from = at(0.1);
    if (before < 0.9f && after >= 0.9f) to = at(0.9);
  }
  return to - from;
}

// Between a tenth and nine tenths a disc's penumbra has 0.687 of its width, and a square's 0.8. The square of cssm that
// stands for a disc has the same variance, so √3/2 of the disc's width: 1.01 times as much.
TEST_F(PrefilterTest, ConvolutionSoftShadowsAreAsWideAsTheSunAndTheHeightAsk) {
  for (const bool square : {false, true}) {
    for (const float angle : {1.0f, 2.0f, 4.0f}) {
      ParamSet params = renderer_->params();
      params.set("technique", std::string("cssm"));
      params.set("cssm.terms", 16);
      params.set("cascades.count", 1);
      params.set("cascades.size", 1024);
      params.set("sun.angle", angle);
      params.set("sun.shape", std::string(square ? "square" : "disc"));
      TriangleScene scene = half_plane_over_ground(256);
      scene.height = 4;
      scene.projection = orthographic(0.7f, 0.7f * 4 / 256, 0.1f, 5);
      const double exact = (square ? 0.8 : 0.687) * 2 * 5 * std::tan(static_cast<double>(glm::radians(angle)) / 2);
      const double width = width_of(renderer_->render(scene, params)) / exact;
      std::printf("cssm, %s of %g degrees: %.3f of the exact width\n", square ? "square" : "disc",
                  static_cast<double>(angle), width);
      EXPECT_NEAR(width, 1, 0.06) << "a sun of " << angle << " degrees";
    }
  }
}

// With a receiver in front of a part of its kernel's depths, the exponential is greater than 1.
TEST_F(PrefilterTest, ReceiversThatFailExponentialsAreCompared) {
  TriangleScene scene;
  scene.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  scene.add_quad({-4, 1, -4}, {0, 0, 8}, {4, 0, 0});     // a shelf, seen from above, and its edge
  scene.add_quad({-4, 3, -4}, {0, 0, 8}, {3.9f, 0, 0});  // shadows the shelf up to 10 cm from its edge
  scene.width = 128;
  scene.height = 4;
  scene.view = glm::lookAt(glm::vec3(-0.4f, 2, 0), glm::vec3(-0.4f, 0, 0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(0.35f, 0.35f * 4 / 128, 0.1f, 2);
  const auto mean_with = [&](const std::string& classification) {
    ParamSet params = parameters("esm");
    params.set("esm.classification", classification);
    const Shadowed shadowed = renderer_->render(scene, params);
    double sum = 0;
    int count = 0;
    for (int x = 0; x < shadowed.width; ++x) {
      const float at = shadowed.point(x, 1).x;
      if (at < -0.3f || at > -0.15f) continue;
      sum += static_cast<double>(shadowed.visibility(x, 1));
      ++count;
    }
    return sum / count;
  };
  EXPECT_GE(mean_with("none"), 0.85);      // the far ground beside the shelf lights it
  EXPECT_LE(mean_with("threshold"), 0.6);  // the share of the kernel under the roof
  EXPECT_NEAR(mean_with("greatest"), mean_with("threshold"), 0.02);
}

// Beside a narrow gap in a shelf, the exponential of the ground below the gap makes up for what a roof takes: the
// result is below 1, and wrong. The greatest depth shows that the kernel reaches behind the receiver.
TEST_F(PrefilterTest, TheGreatestDepthFindsWhatTheThresholdMisses) {
  TriangleScene scene;
  scene.add_quad({-4, 0, -4}, {0, 0, 8}, {8, 0, 0});
  scene.add_quad({-4, 0.02f, -4}, {0, 0, 8}, {3.9f, 0, 0});  // a shelf up to x = -0.1, little above the ground
  scene.add_quad({-4, 3, -4}, {0, 0, 8}, {3.75f, 0, 0});     // its roof, up to x = -0.25
  scene.width = 64;
  scene.height = 4;
  scene.view = glm::lookAt(glm::vec3(-0.22f, 2, 0), glm::vec3(-0.22f, 0, 0), glm::vec3(0, 0, -1));
  scene.projection = orthographic(0.02f, 0.02f * 4 / 64, 0.1f, 2);
  const auto middle = [&](const std::string& classification) {
    ParamSet params = parameters("esm");
    params.set("esm.classification", classification);
    params.set("esm.threshold", 0.5f);
    const Shadowed shadowed = renderer_->render(scene, params);
    return static_cast<double>(shadowed.visibility(32, 1));
  };
  const double unclassified = middle("none");
  EXPECT_NEAR(middle("threshold"), unclassified, 1e-6);
  EXPECT_LT(middle("greatest"), unclassified - 0.05) << unclassified;
}

}  // namespace
}  // namespace penumbra::test

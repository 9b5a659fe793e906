// Noise and sequences: how sample points differ from pixel to pixel and from frame to frame.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "gpu/triangle_scene.h"

namespace penumbra::test {
namespace {

constexpr int side = 128;      // pixels: four tiles of noise
constexpr float grid = 0.02f;  // rows lie otherwise on the map's texels

// The penumbra of a half-plane 5 m up, which fills the picture, under a sun of 8 degrees.
TriangleScene wide_penumbra() {
  constexpr float radius = 5 * 0.0699f;
  TriangleScene scene = half_plane_over_ground(side);
  scene.projection = orthographic(0.9f * radius, 0.9f * radius, 0.05f, 5);
  return scene;
}

class ShadowSampling : public TriangleTest {
 protected:
  void SetUp() override {
    TriangleTest::SetUp();
    params_ = std::make_unique<ParamSet>(renderer_->params());
    params_->set("sun.angle", 8.0f);
    params_->set("cascades.count", 1);
    params_->set("cascades.size", 256);
  }
  void TearDown() override {
    params_.reset();
    TriangleTest::TearDown();
  }

  Shadowed draw() { return renderer_->render(wide_penumbra(), *params_); }
  // Draws the next frame of a camera that does not move.
  Shadowed draw_next() {
    return renderer_->render(wide_penumbra(), *params_, [](shadow::Inputs& inputs) {
      inputs.view.last_view = inputs.view.view;
      inputs.view.last_projection = inputs.view.projection;
    });
  }

  std::unique_ptr<ParamSet> params_;
};

std::vector<float> penumbra_radii(const Shadowed& shadowed) {
  std::vector<float> radii;
  for (size_t i = 1; i < shadowed.mask.size(); i += 4) radii.push_back(shadowed.mask[i]);
  return radii;
}

TEST_F(ShadowSampling, WithoutNoiseEveryPixelOfAColumnIsTheSame) {
  for (const std::string noise : {"none", "white", "blue", "void_and_cluster", "spatiotemporal", "heitz_belcour"}) {
    params_->set("sampling.noise", noise);
    const Shadowed shadowed = draw();
    int differ = 0;
    for (int x = 0; x < side; ++x) {
      differ += std::abs(shadowed.visibility(x, 10) - shadowed.visibility(x, 70)) > grid ? 1 : 0;
    }
    if (noise == "none") {
      EXPECT_EQ(differ, 0);
    } else {
      EXPECT_GT(differ, side / 2) << noise;
    }
  }
}

TEST_F(ShadowSampling, NoiseRepeatsAfter64Pixels) {
  const Shadowed shadowed = draw();
  for (int x = 0; x < side; ++x) EXPECT_NEAR(shadowed.visibility(x, 10), shadowed.visibility(x, 74), grid) << x;
}

TEST_F(ShadowSampling, SeedsTurnThePoints) {
  const Shadowed zero = draw();
  params_->set("sampling.seed", 1);
  EXPECT_NE(draw().mask, zero.mask);
}

TEST_F(ShadowSampling, StillPointsStay) {
  const Shadowed first = draw();
  EXPECT_EQ(draw_next().mask, first.mask);
}

TEST_F(ShadowSampling, TheFilterVariesAndTheKernelKeepsItsSize) {
  for (const std::string pattern : {"poisson", "vogel"}) {
    for (const std::string sequence : {"shift", "set"}) {
      params_->set("sampling.filter_pattern", pattern);
      params_->set("sampling.filter_sequence", sequence);
      const Shadowed first = draw();
      const Shadowed next = draw_next();
      EXPECT_EQ(penumbra_radii(next), penumbra_radii(first)) << sequence;
      // Vogel's points are always the same.
      EXPECT_EQ(next.mask != first.mask, pattern == "poisson" || sequence == "shift") << pattern << " " << sequence;
      EXPECT_EQ(draw().mask, first.mask) << "begins anew after a cut";
    }
  }
}

TEST_F(ShadowSampling, TheBlockerStepVariesWhenAsked) {
  params_->set("sampling.blocker_sequence", std::string("shift"));
  const Shadowed first = draw();
  EXPECT_NE(penumbra_radii(draw_next()), penumbra_radii(first));
}

// Mean under a Gaussian of 1.5 pixels, for pixels away from the picture's edges.
std::vector<double> blurred(const std::vector<float>& picture) {
  constexpr int reach = 5;
  std::vector<double> result;
  for (int y = reach; y < side - reach; ++y) {
    for (int x = reach; x < side - reach; ++x) {
      double sum = 0;
      double weights = 0;
      for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
          const double weight = std::exp(-(dx * dx + dy * dy) / (2 * 1.5 * 1.5));
          sum += weight * picture[static_cast<size_t>((y + dy) * side + x + dx)];
          weights += weight;
        }
      }
      result.push_back(sum / weights);
    }
  }
  return result;
}

double psnr(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return -10 * std::log10(sum / static_cast<double>(a.size()));
}

TEST_F(ShadowSampling, FilteredBlueNoiseBeatsFilteredWhiteNoise) {
  params_->set("technique", std::string("brute_force"));
  params_->set("brute_force.every_texel", true);
  const std::vector<double> truth = blurred(draw().visibilities());
  params_->set("technique", std::string("pcss"));
  params_->set("pcss.blocker_taps", 64);
  params_->set("sampling.scramble", std::string("shift"));
  for (const std::string pattern : {"regular", "uniform", "poisson", "poisson_hierarchical", "hammersley", "halton"}) {
    params_->set("sampling.filter_pattern", pattern);
    for (const int taps : {1, 8}) {
      params_->set("pcss.filter_taps", taps);
      const auto quality = [&](const char* noise) {
        params_->set("sampling.noise", std::string(noise));
        return psnr(blurred(draw().visibilities()), truth);
      };
      const double white = quality("white");
      const double blue = quality("blue");
      std::printf("%s, %d filter taps: white %.1f dB, blue %.1f dB\n", pattern.c_str(), taps, white, blue);
      EXPECT_GE(blue, white + (taps == 1 ? 4 : 0)) << pattern << ", " << taps << " taps";
    }
  }
}

// Keys are made for the errors themselves, and not for the points.
TEST_F(ShadowSampling, FilteredKeysHaveLessErrorThanBlueNoise) {
  params_->set("technique", std::string("brute_force"));
  params_->set("brute_force.every_texel", true);
  const std::vector<double> truth = blurred(draw().visibilities());
  params_->set("technique", std::string("pcss"));
  params_->set("pcss.blocker_taps", 64);
  params_->set("sampling.scramble", std::string("shift"));
  params_->set("sampling.filter_pattern", std::string("hammersley"));
  for (const int taps : {1, 2, 4, 8, 16}) {
    params_->set("pcss.filter_taps", taps);
    const auto quality = [&](const char* noise) {
      params_->set("sampling.noise", std::string(noise));
      return psnr(blurred(draw().visibilities()), truth);
    };
    const double white = quality("white"), blue = quality("blue"), keys = quality("heitz_belcour");
    std::printf("%d filter taps: white %.1f dB, blue %.1f dB, keys %.1f dB\n", taps, white, blue, keys);
    EXPECT_GT(keys, blue + (taps == 1 ? -0.5 : 0.5)) << taps << " taps";
  }
}

// The means of frames that follow each other, of one tap each, as they are and filtered.
TEST_F(ShadowSampling, FramesOfKeysAndOfSpatiotemporalNoiseComplementEachOther) {
  constexpr int frames = 16;
  params_->set("technique", std::string("brute_force"));
  params_->set("brute_force.every_texel", true);
  const std::vector<float> exact = draw().visibilities();
  params_->set("technique", std::string("pcss"));
  params_->set("pcss.blocker_taps", 64);
  params_->set("pcss.filter_taps", 1);
  params_->set("sampling.scramble", std::string("shift"));
  params_->set("sampling.filter_sequence", std::string("shift"));
  struct Quality {
    double as_is, filtered;
  };
  const auto quality = [&](const char* noise) {
    params_->set("sampling.noise", std::string(noise));
    std::vector<float> mean(exact.size());
    for (int frame = 0; frame < frames; ++frame) {
      const std::vector<float> drawn = (frame == 0 ? draw() : draw_next()).visibilities();
      for (size_t i = 0; i < mean.size(); ++i) mean[i] += drawn[i] / frames;
    }
    const Quality found{.as_is = psnr({mean.begin(), mean.end()}, {exact.begin(), exact.end()}),
                        .filtered = psnr(blurred(mean), blurred(exact))};
    std::printf("%s: %.1f dB, filtered %.1f dB\n", noise, found.as_is, found.filtered);
    return found;
  };
  const Quality blue = quality("blue");
  for (const char* noise : {"spatiotemporal", "heitz_belcour"}) {
    const Quality found = quality(noise);
    EXPECT_GT(found.as_is, blue.as_is + 2) << noise;
    EXPECT_GT(found.filtered, blue.filtered + 4) << noise;
  }
}

// Four frames of four taps are at the points of one frame of sixteen.
TEST_F(ShadowSampling, EachFrameTakesTheSamplesOfItsKeyThatFollow) {
  constexpr int frames = 4;
  params_->set("sampling.noise", std::string("heitz_belcour"));
  params_->set("sampling.filter_sequence", std::string("shift"));
  params_->set("pcss.filter_taps", 16);
  const std::vector<float> together = draw().visibilities();
  params_->set("pcss.filter_taps", 16 / frames);
  std::vector<float> mean(together.size());
  for (int frame = 0; frame < frames; ++frame) {
    const std::vector<float> drawn = (frame == 0 ? draw() : draw_next()).visibilities();
    for (size_t i = 0; i < mean.size(); ++i) mean[i] += drawn[i] / frames;
  }
  for (size_t i = 0; i < mean.size(); ++i) ASSERT_NEAR(mean[i], together[i], 1e-3) << i;  // the mask holds half floats
}

// Rotated by gradient noise, few slices leave less than if rotated by blue noise, since nine pixels of it are nearly
// the rotations of nine times as many slices.
TEST_F(ShadowSampling, FilteredSlicesHaveLeastNoiseFromInterleavedGradients) {
  params_->set("technique", std::string("slices"));
  params_->set("slices.samples", 16);
  const auto filtered = [&](const char* noise, int azimuths) {
    params_->set("sampling.noise", std::string(noise));
    params_->set("slices.azimuths", azimuths);
    return blurred(draw().visibilities());
  };
  const std::vector<double> converged = filtered("white", 128);
  const double white = psnr(filtered("white", 6), converged), blue = psnr(filtered("blue", 6), converged);
  const double gradient = psnr(filtered("interleaved_gradient", 6), converged);
  std::printf("white %.1f dB, blue %.1f dB, interleaved gradient %.1f dB\n", white, blue, gradient);
  EXPECT_GT(blue, white + 3);
  EXPECT_GT(gradient, blue);
}

}  // namespace
}  // namespace penumbra::test

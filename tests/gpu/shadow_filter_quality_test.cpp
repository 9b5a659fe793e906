// Filters of the mask over real penumbrae: agreement of the drivers, width, noise.

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

const std::vector<std::string> all_filters{"none", "box", "gaussian", "bilateral", "bilateral_separable", "isophote"};
constexpr int side = 128;

// A half-plane 5 m up over a ground: under a sun of 8 degrees a penumbra of 0.7 m in the middle of the picture, of
// whose width the picture shows `part`.
TriangleScene half_plane(float part) {
  constexpr float radius = 5 * 0.0699268f;
  TriangleScene scene = half_plane_over_ground(side);
  scene.projection = orthographic(part * radius, part * radius, 0.05f, 5);
  return scene;
}

class ShadowFilterQuality : public TriangleTest {
 protected:
  void SetUp() override {
    TriangleTest::SetUp();
    params_ = std::make_unique<ParamSet>(renderer_->params());
    params_->set("sun.angle", 8.0f);
    params_->set("cascades.count", 1);
    params_->set("cascades.size", 512);
    use_8_taps();
  }
  void TearDown() override {
    params_.reset();
    TriangleTest::TearDown();
  }

  void set(const char* name, const std::string& word) { params_->set(name, word); }
  void use_8_taps() {
    set("technique", "pcss");
    params_->set("pcss.blocker_taps", 8);
    params_->set("pcss.filter_taps", 8);
    set("sampling.blocker_pattern", "hammersley");
    set("sampling.filter_pattern", "hammersley");
    set("sampling.scramble", "shift");
    set("sampling.noise", "blue");
  }
  void use_every_texel() {
    set("technique", "brute_force");
    params_->set("brute_force.every_texel", true);
  }
  Shadowed draw(const TriangleScene& scene, const std::string& filter) {
    set("filter.visibility", filter);
    return renderer_->render(scene, *params_);
  }
  // Draws the same into a part of larger textures, with other values beside it.
  std::vector<float> draw_part(const TriangleScene& scene, const shadow::Rect& part) {
    renderer_->render(scene, *params_, [&](shadow::Inputs& in) {
      in.depth = larger(in.depth, "large depth", GL_DEPTH_COMPONENT32F, part);
      in.normals = larger(in.normals, "large normals", GL_RG32F, part);
      in.viewport = part;
    });
    const gl::Texture& mask = *renderer_->mask().texture;
    const std::vector<float> texels = gl::read_floats(mask, 4);
    std::vector<float> inside;
    for (int y = 0; y < part.height; ++y) {
      const auto row = texels.begin() + 4 * ((y + part.y) * mask.width() + part.x);
      inside.insert(inside.end(), row, row + 4 * part.width);
    }
    return inside;
  }

  std::unique_ptr<ParamSet> params_;

 private:
  shadow::TextureView larger(const shadow::TextureView& from, const char* name, GLenum format,
                             const shadow::Rect& part) {
    const gl::Texture& to =
        renderer_->device().target(name, {.format = format, .width = part.width + 40, .height = part.height + 30});
    const float beside = 0.01f;
    gl::glClearTexImage(to.id(), 0, format == GL_RG32F ? GL_RED : GL_DEPTH_COMPONENT, GL_FLOAT, &beside);
    gl::glCopyImageSubData(from.id, GL_TEXTURE_2D, 0, 0, 0, 0, to.id(), GL_TEXTURE_2D, 0, part.x, part.y, 0, part.width,
                           part.height, 1);
    return {to.id(), to.width(), to.height()};
  }
};

TriangleScene odd_box() {
  TriangleScene scene = box_on_ground();
  scene.width = 75;
  scene.height = 53;
  scene.projection = perspective(0.8f, 75.0f / 53, 0.1f);
  return scene;
}

TEST_F(ShadowFilterQuality, FragmentAndComputeGiveTheSameMask) {
  params_->set("filter.width", 0.4f);  // so wide that taps are spaced out
  const shadow::Rect part{13, 5, 75, 53};
  for (const std::string& filter : all_filters) {
    for (const std::string median : {"none", "median"}) {
      set("filter.penumbra", median);
      set("driver", "fragment");
      const std::vector<float> mask = draw(odd_box(), filter).mask;
      const std::vector<float> of_part = draw_part(odd_box(), part);
      set("driver", "compute");
      EXPECT_EQ(draw(odd_box(), filter).mask, mask) << filter << ", penumbra " << median;
      EXPECT_EQ(draw_part(odd_box(), part), of_part) << filter << ", penumbra " << median;
    }
  }
}

TEST_F(ShadowFilterQuality, NothingBesideTheViewportIsRead) {
  params_->set("filter.width", 0.4f);
  set("filter.penumbra", "median");
  set("sampling.noise", "none");  // noise depends on the position in the textures
  for (const std::string driver : {"fragment", "compute"}) {
    set("driver", driver);
    for (const std::string& filter : all_filters) {
      const std::vector<float> whole = draw(odd_box(), filter).mask;
      EXPECT_EQ(draw_part(odd_box(), {13, 5, 75, 53}), whole) << filter;
    }
  }
}

// The mean of each column of the mask.
std::vector<double> profile(const Shadowed& shadowed) {
  std::vector<double> means(side, 0.0);
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) means[static_cast<size_t>(x)] += shadowed.visibility(x, y) / side;
  }
  return means;
}

// The position at which a rising profile first reaches a value, pixels.
double crossing(const std::vector<double>& profile, double value) {
  for (size_t x = 1; x < profile.size(); ++x) {
    if (profile[x] >= value) {
      return static_cast<double>(x) - (profile[x] - value) / (profile[x] - profile[x - 1]);
    }
  }
  return NAN;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST_F(ShadowFilterQuality, APenumbraKeepsItsMeanAndItsWidth) {
  params_->set("cascades.size", 256);  // every texel is compared
  for (const std::string shape : {"disc", "square"}) {
    set("sun.shape", shape);
    use_every_texel();
    const std::vector<double> raw = profile(draw(half_plane(1.8f), "none"));
    const double width = crossing(raw, 0.9) - crossing(raw, 0.1);
    for (const std::string& filter : all_filters) {
      const std::vector<double> filtered = profile(draw(half_plane(1.8f), filter));
      const double filtered_width = crossing(filtered, 0.9) - crossing(filtered, 0.1);
      std::printf("%s, %s: 10 to 90 %% in %.2f pixels, was %.2f\n", shape.c_str(), filter.c_str(), filtered_width,
                  width);
      EXPECT_NEAR(filtered_width / width, 1, filter == "isophote" ? 0.03 : 0.1) << filter;
      EXPECT_NEAR(mean_of(filtered), mean_of(raw), 0.003) << filter;
      EXPECT_NEAR(crossing(filtered, 0.5), crossing(raw, 0.5), 0.5) << filter;
    }
  }
}

// Pixels of a mask of fewer pixels are twice as far apart: a kernel of as many of them would be twice as wide.
TEST_F(ShadowFilterQuality, AMaskOfFewerPixelsIsNotBlurredMoreInANarrowPenumbra) {
  params_->set("sun.angle", 2.25f);  // a penumbra of 20 pixels
  use_every_texel();
  const TriangleScene scene = half_plane(1.8f);
  const auto widening = [&] {
    const std::vector<double> raw = profile(draw(scene, "none")), filtered = profile(draw(scene, "isophote"));
    return (crossing(filtered, 0.9) - crossing(filtered, 0.1)) / (crossing(raw, 0.9) - crossing(raw, 0.1)) - 1;
  };
  const double full = widening();
  params_->set("mask.scale", 2);
  const double scaled = widening();
  std::printf("10 to 90 %% wider by %.2f %%, in a mask of fewer pixels by %.2f %%\n", 100 * full, 100 * scaled);
  EXPECT_NEAR(scaled, full, 0.01);
  EXPECT_LT(scaled, 0.03);
}

double rmse(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) sum += static_cast<double>(a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

TEST_F(ShadowFilterQuality, TheSeparableFilterIsCloseToTheFullOne) {
  const TriangleScene scene = box_on_ground(128);
  params_->set("filter.width", 0.4f);
  const std::vector<float> raw = draw(scene, "none").visibilities();
  const std::vector<float> full = draw(scene, "bilateral").visibilities();
  const std::vector<float> separable = draw(scene, "bilateral_separable").visibilities();
  std::printf("RMSE of the separable filter to the full one: %.4f; of no filter: %.4f\n", rmse(separable, full),
              rmse(raw, full));
  EXPECT_LT(rmse(separable, full), 0.2 * rmse(raw, full));
}

// Root mean square of what differs within columns, which lie along the edge of the shadow.
double noise_of(const Shadowed& shadowed) {
  const std::vector<double> means = profile(shadowed);
  double sum = 0;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      const double off = static_cast<double>(shadowed.visibility(x, y)) - means[static_cast<size_t>(x)];
      sum += off * off;
    }
  }
  return std::sqrt(sum / (side * side));
}

TEST_F(ShadowFilterQuality, NoiseIsFilteredAway) {
  const TriangleScene scene = half_plane(0.9f);
  const double raw = noise_of(draw(scene, "none"));
  for (const std::string& filter : all_filters) {
    if (filter == "none") continue;
    const double left = noise_of(draw(scene, filter));
    std::printf("8/8 taps, %s: %.1f %% of the noise\n", filter.c_str(), 100 * left / raw);
    EXPECT_LT(left, 0.15 * raw) << filter;
  }
}

TEST_F(ShadowFilterQuality, AlongIsophotesLessIsBlurredAndMoreNoiseIsRemoved) {
  const TriangleScene scene = half_plane(1.8f);
  use_every_texel();
  const std::vector<float> truth = draw(scene, "none").visibilities();
  set("technique", "slices");
  params_->set("slices.azimuths", 6);
  set("sampling.noise", "interleaved_gradient");
  const double separable = rmse(draw(scene, "bilateral_separable").visibilities(), truth);
  params_->set("filter.taps", 4);
  const double along = rmse(draw(scene, "isophote").visibilities(), truth);
  std::printf("6 slices, RMSE of bilateral_separable %.4f, of isophote %.4f\n", separable, along);
  EXPECT_LT(along, 0.4 * separable);  // 0.33; a mean across these lines, along the gradient, gives 0.55
}

}  // namespace
}  // namespace penumbra::test

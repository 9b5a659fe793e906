// RMSE, PSNR, bias, maximum and percentile on pictures whose figures are known.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "metrics/error_figures.h"
#include "metrics/quality.h"
#include "support/gltf_files.h"
#include "support/pictures.h"

namespace penumbra::metrics {
namespace {

using test::Grey;

constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();

TEST(ErrorFigures, OfAConstantError) {
  const Grey reference(10, 7, 0.5f), brighter(10, 7, 0.6f);
  const ErrorFigures figures = error_figures(brighter, reference);
  EXPECT_EQ(figures.samples, 70u);
  EXPECT_EQ(figures.penumbra_samples, 70u);
  EXPECT_NEAR(figures.rmse, 0.1, 1e-7);
  EXPECT_NEAR(figures.psnr, 20, 1e-5);
  EXPECT_NEAR(figures.psnr_penumbra, 20, 1e-5);
  EXPECT_NEAR(figures.bias, 0.1, 1e-7);
  EXPECT_NEAR(figures.max, 0.1, 1e-7);
  EXPECT_NEAR(figures.p99, 0.1, 1e-7);
  EXPECT_NEAR(error_figures(reference, brighter).bias, -0.1, 1e-7) << "bias has a sign";
}

TEST(ErrorFigures, OfTheGreatestErrorHaveNoSignOnZero) {
  const double psnr = error_figures(Grey(4, 4, 1.0f), Grey(4, 4, 0.0f)).psnr;
  EXPECT_EQ(psnr, 0);
  EXPECT_FALSE(std::signbit(psnr));
}

TEST(ErrorFigures, OfEqualPicturesAreZeroAndInfinite) {
  const Grey picture(4, 4, 0.3f);
  const ErrorFigures figures = error_figures(picture, picture);
  EXPECT_EQ(figures.rmse, 0);
  EXPECT_EQ(figures.psnr, infinity);
  EXPECT_EQ(figures.psnr_penumbra, infinity);
  EXPECT_EQ(figures.max, 0);
}

TEST(ErrorFigures, PenumbraIsTheReferencesFrom2To98Percent) {
  Grey reference(4, 1, 0.0f), shown(4, 1, 0.0f);
  reference.pixels = {0.0f, 0.02f, 0.98f, 1.0f};
  shown.pixels = {1.0f, 0.03f, 0.97f, 0.0f};
  const ErrorFigures figures = error_figures(shown, reference);
  EXPECT_EQ(figures.penumbra_samples, 2u);
  EXPECT_NEAR(figures.psnr_penumbra, 40, 1e-4);
  EXPECT_NEAR(figures.rmse, std::sqrt(2.0002 / 4), 1e-6);
}

TEST(ErrorFigures, PercentileIsTheNearestRank) {
  const Grey reference(200, 1, 0.0f);
  const Grey shown(200, 1, [](int x, int) { return ((x * 77) % 200) / 1000.0; });  // 0, 0.001 … 0.199, shuffled
  EXPECT_NEAR(error_figures(shown, reference).p99, 0.197, 1e-6) << "198 of 200 are no greater";
  EXPECT_NEAR(error_figures(shown, reference).max, 0.199, 1e-6);
  const Grey fewer(150, 1, [](int x, int) { return ((x * 77) % 150) / 1000.0; });
  EXPECT_NEAR(error_figures(fewer, Grey(150, 1, 0.0f)).p99, 0.148, 1e-6) << "148 of 150 are not 99 of 100 yet";
}

TEST(ErrorFigures, LeaveOutWhatIsNoReceiver) {
  Grey reference(3, 1, 0.5f), shown(3, 1, 0.5f);
  shown.pixels = {0.5f, 0.75f, 0.0f};
  reference.pixels[2] = nan;
  const std::vector<std::uint8_t> receivers{1, 255, 0};
  const ErrorFigures figures = error_figures(shown, reference, receivers);
  EXPECT_EQ(figures.samples, 2u);
  EXPECT_EQ(figures.not_finite, 0u);
  EXPECT_NEAR(figures.bias, 0.125, 1e-7);
}

TEST(ErrorFigures, MeasureEveryChannel) {
  const std::vector<float> a{0, 0, 0, 1, 1, 1}, b{0, 0, 0.6f, 1, 1, 1};
  const std::vector<std::uint8_t> second{0, 1};
  EXPECT_NEAR(error_figures({2, 1, b, 3}, {2, 1, a, 3}).bias, 0.1, 1e-7);
  EXPECT_EQ(error_figures({2, 1, b, 3}, {2, 1, a, 3}, second).samples, 3u);
  EXPECT_EQ(error_figures({2, 1, b, 3}, {2, 1, a, 3}, second).max, 0);
}

TEST(ErrorFigures, CountValuesThatAreNoNumbersAsTheErrorOne) {
  const Grey reference(4, 1, [](int x, int) { return x < 2 ? 0 : 1; });
  for (const float bad : {nan, infinity, -infinity}) {
    Grey shown = reference;
    shown.at(1, 0) = bad;
    const ErrorFigures dark = error_figures(shown, reference);
    EXPECT_EQ(dark.not_finite, 1u);
    EXPECT_EQ(dark.max, 1);
    EXPECT_EQ(dark.rmse, 0.5);
    EXPECT_EQ(dark.bias, 0.25);
    shown.at(1, 0) = 0;
    shown.at(3, 0) = bad;
    EXPECT_EQ(error_figures(shown, reference).bias, -0.25);
  }
}

TEST(ErrorFigures, OfNothingAreNoNumbers) {
  const Grey empty(0, 0, 0.0f), one(1, 1, 0.25f);
  const std::vector<std::uint8_t> none{0};
  for (const ErrorFigures& figures : {error_figures(empty, empty), error_figures(one, one, none)}) {
    EXPECT_EQ(figures.samples, 0u);
    for (const double figure :
         {figures.rmse, figures.psnr, figures.psnr_penumbra, figures.bias, figures.max, figures.p99})
      EXPECT_TRUE(std::isnan(figure));
  }
  EXPECT_EQ(error_figures(one, one).rmse, 0);
}

TEST(ErrorFigures, RefusePicturesThatDoNotMatch) {
  const Grey a(4, 2, 0.0f), b(2, 4, 0.0f);
  EXPECT_EQ(test::error_of([&] { error_figures(a, b); }), "the pictures differ in size: 4 x 2 and 2 x 4 pixels");
  const std::vector<float> rgb(24);
  EXPECT_EQ(test::error_of([&] { error_figures(a, {4, 2, rgb, 3}); }), "the pictures differ in channels: 1 and 3");
  const std::vector<std::uint8_t> receivers(7);
  EXPECT_EQ(test::error_of([&] { error_figures(a, a, receivers); }), "7 receivers for a picture of 4 x 2 pixels");
  EXPECT_EQ(test::error_of([&] {
              error_figures({4, 2, rgb}, {4, 2, rgb});
            }),
            "a picture of 4 x 2 pixels with 1 channels has 24 values");
  Grey bad = a;
  bad.at(2, 1) = nan;
  EXPECT_EQ(test::error_of([&] { error_figures(a, bad); }), "the reference is not finite at pixel 2,1");
}

TEST(Quality, HasTheFiguresOfEveryMetric) {
  const Grey reference = test::ramp(48, 0, 20), shown = test::ramp(48, 0, 10);
  const Quality quality = quality_of(shown, reference);
  EXPECT_EQ(quality.errors.rmse, error_figures(shown, reference).rmse);
  EXPECT_GT(quality.flip, 0);
  EXPECT_EQ(quality.flip_map.size(), reference.pixels.size());
  EXPECT_LT(quality.ssim, 1);
  EXPECT_NEAR(quality.width.relative, 0.5, 0.02);
  const Grey empty(0, 0, 0.0f);
  EXPECT_TRUE(std::isnan(quality_of(empty, empty).flip));
}

}  // namespace
}  // namespace penumbra::metrics

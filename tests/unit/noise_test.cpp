#include "shadow/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "core/error.h"

namespace penumbra::shadow {
namespace {

TEST(Noise, EachChannelHoldsEachRankOnce) {
  for (const std::string& kind : noise_kinds()) {
    const NoiseTile tile = make_noise(kind, 16, 2, 1);
    for (int channel = 0; channel < 2; ++channel) {
      std::set<int> ranks;
      for (int pixel = 0; pixel < tile.count(); ++pixel) ranks.insert(tile.rank(pixel, channel));
      EXPECT_EQ(static_cast<int>(ranks.size()), tile.count()) << kind;
      EXPECT_EQ(*ranks.rbegin(), tile.count() - 1) << kind;
    }
  }
}

TEST(Noise, BlueNoiseHasHardlyAnyLowFrequencies) {
  const NoiseTile small = make_noise("blue", 32, 2, 1);
  const NoiseTile blue = built_in_noise("blue");
  const NoiseTile voids = built_in_noise("void_and_cluster");
  const NoiseTile spatiotemporal = built_in_noise("spatiotemporal");
  const NoiseTile white = built_in_noise("white");
  for (int channel = 0; channel < 2; ++channel) {
    EXPECT_LT(low_to_high_power(small, channel), 0.02);
    EXPECT_LT(low_to_high_power(blue, channel), 0.02);
    EXPECT_LT(low_to_high_power(voids, channel), 0.001);
    EXPECT_LT(low_to_high_power(spatiotemporal, channel), 0.002);
    EXPECT_NEAR(low_to_high_power(white, channel), 1, 0.3);
  }
}

// Standard deviation of the mean of 3 × 3 pixels; 0.096 for white noise.
double deviation_of_means(const NoiseTile& tile, int channel) {
  double squares = 0;
  const int last = tile.size - 2;
  for (int y = 1; y <= last; ++y) {
    for (int x = 1; x <= last; ++x) {
      double sum = 0;
      for (int i = 0; i < 9; ++i) sum += tile.value((y + i / 3 - 1) * tile.size + x + i % 3 - 1, channel);
      squares += (sum / 9 - 0.5) * (sum / 9 - 0.5);
    }
  }
  return std::sqrt(squares / (last * last));
}

TEST(Noise, NinePixelsOfInterleavedGradientNoiseHaveNearlyTheSameMean) {
  for (int channel = 0; channel < 2; ++channel) {
    EXPECT_LT(deviation_of_means(built_in_noise("interleaved_gradient"), channel), 0.04);
    EXPECT_GT(deviation_of_means(built_in_noise("white"), channel), 0.08);
  }
}

// Mean difference of a pixel's values in frames that follow each other; 1/3 for white noise.
double difference_of_frames(const NoiseTile& tile, int channel) {
  const int pixels = tile.size * tile.size;
  double sum = 0;
  for (int pixel = 0; pixel < tile.count(); ++pixel)
    sum += std::abs(tile.value(pixel, channel) - tile.value((pixel + pixels) % tile.count(), channel));
  return sum / tile.count();
}

TEST(Noise, FramesOfSpatiotemporalNoiseDifferMoreThanByChance) {
  const NoiseTile tile = built_in_noise("spatiotemporal");
  EXPECT_EQ(tile.frames, spatiotemporal_frames);
  for (int channel = 0; channel < 2; ++channel) EXPECT_GT(difference_of_frames(tile, channel), 0.38);
}

// FNV-1a hash of the ranks.
std::uint64_t digest(const NoiseTile& tile) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const std::uint16_t rank : tile.ranks) hash = (hash ^ rank) * 0x100000001b3U;
  return hash;
}

constexpr std::uint64_t blue_digest = 13088325229565141185U;

TEST(Noise, IsTheSameOnEveryMachine) {
  EXPECT_EQ(digest(make_noise("white", 16, 2, 5)), 11397280655061326889U);
  EXPECT_EQ(digest(make_noise("blue", 16, 2, 5, 1)), blue_digest);
  EXPECT_EQ(digest(make_noise("void_and_cluster", 16, 2, 5)), 15497227018239437017U);
  EXPECT_EQ(digest(make_noise("interleaved_gradient", 16, 2, 5)), 1682607693411162813U);
  EXPECT_EQ(digest(make_noise("spatiotemporal", 16, 2, 5)), 3365623650642415889U);
}

TEST(Noise, WhatProgressThrowsEndsAllThreads) {
  const auto progress = [](double) { fail("enough"); };
  EXPECT_THROW(make_noise("blue", 32, 2, 5, 3, progress), Error);
}

TEST(Noise, IsTheSameForEveryNumberOfThreads) { EXPECT_EQ(digest(make_noise("blue", 16, 2, 5, 3)), blue_digest); }

// After a change to how noise is made, update the digests above and bake these tiles again.
TEST(Noise, TheBuiltInTilesAreThoseOfToday) {
  EXPECT_EQ(digest(built_in_noise("blue")), 1577704634477514093U);
  EXPECT_EQ(digest(built_in_noise("void_and_cluster")), 6682990548504888333U);
  EXPECT_EQ(digest(make_noise("void_and_cluster", 64, 2, 1)), 6682990548504888333U);
  EXPECT_EQ(digest(built_in_noise("spatiotemporal")), 966421686694536889U);
}

TEST(Noise, ProgressGrowsToTheEnd) {
  double last = 0;
  make_noise("void_and_cluster", 16, 3, 1, 0, [&](double done) {
    EXPECT_GT(done, last);
    last = done;
  });
  EXPECT_EQ(last, 1);
}

TEST(Noise, RefusesSizesAndKindsThatItCannotMake) {
  EXPECT_THROW(make_noise("blue", 24, 2, 1), Error);
  EXPECT_THROW(make_noise("blue", 512, 2, 1), Error);
  EXPECT_THROW(make_noise("blue", 0, 2, 1), Error);
  EXPECT_THROW(make_noise("blue", 32, 4, 1), Error);
  EXPECT_THROW(make_noise("spatiotemporal", 80, 2, 1), Error);
  EXPECT_THROW(make_noise("pink", 32, 2, 1), Error);
}

}  // namespace
}  // namespace penumbra::shadow

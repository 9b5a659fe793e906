#include "shadow/sample_keys.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/random.h"

namespace penumbra::shadow {
namespace {

// Of any aligned run of 2^k samples of any pixel, each box of area 2^-k that halving the square makes has one.
TEST(SampleKeys, EachRunOfSamplesHasOneInEachElementaryInterval) {
  for (const SampleKey& key : {SampleKey{}, SampleKey{.x = 93, .y = 200, .order = 171}}) {
    for (int log_count = 0; log_count <= 8; ++log_count) {
      const int count = 1 << log_count;
      for (int first = 0; first < keyed_point_count; first += count) {
        for (int log_columns = 0; log_columns <= log_count; ++log_columns) {
          const int columns = 1 << log_columns, rows = count / columns;
          std::set<std::pair<int, int>> boxes;
          for (int i = first; i < first + count; ++i) {
            const glm::vec2 point = keyed_point(key, i);
            boxes.emplace(static_cast<int>(point.x * columns), static_cast<int>(point.y * rows));
          }
          ASSERT_EQ(static_cast<int>(boxes.size()), count) << first << ", " << columns << " columns";
        }
      }
    }
  }
}

// Mean over half-planes that had no part in making the keys.
double low_to_high_error(const KeyTile& tile, int count) {
  constexpr int planes = 12;
  double sum = 0;
  for (int i = 0; i < planes; ++i) {
    const float angle = 0.3f + 6.2831853f * static_cast<float>(i) / planes;
    const float offset = 0.7f * std::sin(static_cast<float>(i) * 2.4f);
    sum += low_to_high_power(key_errors(tile, count, {std::cos(angle), std::sin(angle)}, offset), tile.size) / planes;
  }
  return sum;
}

TEST(SampleKeys, ErrorsOfNeighboursDiffer) {
  const KeyTile tile = built_in_sample_keys();
  KeyTile random = tile;
  Random numbers(3);
  const auto byte = [&] { return static_cast<std::uint8_t>(numbers.below(256)); };
  for (SampleKey& key : random.keys) key = {.x = byte(), .y = byte(), .order = byte()};
  for (const int count : {1, 2, 4, 8, 16, 32}) {
    const double made = low_to_high_error(tile, count), by_chance = low_to_high_error(random, count);
    std::printf("%d samples: low over high frequencies of the errors %.2f, of random keys %.2f\n", count, made,
                by_chance);
    EXPECT_LT(made, 0.65) << count;
    EXPECT_NEAR(by_chance, 1, 0.2) << count;
  }
}

std::uint64_t digest(const KeyTile& tile) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const SampleKey& key : tile.keys) {
    for (const std::uint8_t byte : {key.x, key.y, key.order}) hash = (hash ^ byte) * 0x100000001b3U;
  }
  return hash;
}

// After a change to how keys are made, update the digests and bake the tile again.
TEST(SampleKeys, AreTheSameOnEveryMachineAndThoseOfToday) {
  double last = 0;
  const KeyTile tile = make_sample_keys(16, 5, [&](double done) {
    EXPECT_GT(done, last);
    last = done;
  });
  EXPECT_EQ(last, 1);
  EXPECT_EQ(digest(tile), 751467352488385882U);
  EXPECT_EQ(digest(built_in_sample_keys()), 6650738055608791405U);
}

TEST(SampleKeys, RefuseOtherSizes) {
  EXPECT_THROW(make_sample_keys(24, 1), Error);
  EXPECT_THROW(make_sample_keys(0, 1), Error);
  EXPECT_THROW(make_sample_keys(512, 1), Error);
}

}  // namespace
}  // namespace penumbra::shadow

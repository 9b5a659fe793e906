// The packed texel as C++: each bit where it belongs, and rounding that is the nearest.

#include "lib/packed_texel.glsl"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace penumbra::glsl {
namespace {

TEST(PackedTexel, EveryHalfIsItsOwnNearest) {
  for (uint bits = 0; bits < 0x7c00u; ++bits) {
    const float value = half_value(bits);
    ASSERT_EQ(half_bits(value), bits);
    ASSERT_EQ(value, unpackHalf2x16(bits).x);
  }
}

TEST(PackedTexel, BetweenTwoHalvesTheNearerOneIsTakenAndTiesGoToTheEven) {
  for (uint bits = 0; bits < 0x7bffu; ++bits) {
    const float low = half_value(bits);
    const float high = half_value(bits + 1);
    const float middle = 0.5f * (low + high);
    ASSERT_EQ(half_bits(middle), (bits & 1u) == 0u ? bits : bits + 1);
    ASSERT_EQ(half_bits(std::nextafter(middle, low)), bits);
    ASSERT_EQ(half_bits(std::nextafter(middle, high)), bits + 1);
  }
}

TEST(PackedTexel, WhatNoHalfHoldsEndsAtTheNearestEnd) {
  EXPECT_EQ(half_bits(1e9f), 0x7bffu) << "65504, not infinite";
  EXPECT_EQ(half_bits(std::numeric_limits<float>::infinity()), 0x7bffu);
  EXPECT_EQ(half_bits(-1.0f), 0u);
  EXPECT_EQ(half_bits(std::numeric_limits<float>::quiet_NaN()), 0u);
}

TEST(PackedTexel, FieldsLieWhereTheFormatSays) {
  EXPECT_EQ(pack_texel(0, 0, false), 0u);
  EXPECT_EQ(pack_texel(1, 0, false), 0x00003c00u);
  EXPECT_EQ(pack_texel(0, 1, false), 0x7fff0000u);
  EXPECT_EQ(pack_texel(0, 0, true), 0x80000000u);
  EXPECT_EQ(pack_texel(65504, 1, true), 0xffff7bffu);
}

TEST(PackedTexel, FieldsComeBackAndDoNotTouchEachOther) {
  for (uint level = 0; level <= 32767u; level += 7) {
    for (const float distance_to : {0.0f, 0.0078125f, 1.0f, 418.25f}) {
      for (const bool invalid : {false, true}) {
        const float visibility = static_cast<float>(level) / 32767.0f;
        const uint texel = pack_texel(distance_to, visibility, invalid);
        ASSERT_EQ(texel_distance(texel), distance_to);
        ASSERT_EQ(texel_visibility(texel), visibility);
        ASSERT_EQ(texel_invalid(texel), invalid);
        ASSERT_FALSE(texel_noise_free(texel));
        ASSERT_TRUE(texel_noise_free(texel | noise_free_bit));
        ASSERT_EQ(texel_frames(with_frames(texel | noise_free_bit, 1)), 1u);
        ASSERT_EQ(texel_distance(texel | noise_free_bit), distance_to);
        ASSERT_EQ(texel_visibility(texel | noise_free_bit), visibility);
      }
    }
  }
}

TEST(PackedTexel, VisibilityIsRoundedToTheNearest) {
  for (float visibility = 0; visibility <= 1; visibility += 0.000217f) {
    EXPECT_NEAR(texel_visibility(pack_texel(3, visibility, false)), visibility, 0.5 / 32767 + 1e-7);
  }
  EXPECT_EQ(texel_visibility(pack_texel(0, 1.5f, false)), 1);
  EXPECT_EQ(texel_visibility(pack_texel(0, -0.5f, false)), 0);
  EXPECT_EQ(texel_visibility(pack_texel(0, std::numeric_limits<float>::quiet_NaN(), false)), 0);
}

TEST(PackedTexel, NotesComeBack) {
  for (int layer = 0; layer < 8; ++layer) {
    for (const bool under_texel : {false, true}) {
      for (const bool narrow : {false, true}) {
        for (uint refusal = HISTORY_KEPT; refusal <= HISTORY_CASTER_MOVED; ++refusal) {
          const uint notes = pack_notes(layer, under_texel, narrow, refusal);
          ASSERT_LT(notes, 256u);
          ASSERT_EQ(notes_layer(notes), layer);
          ASSERT_EQ(notes_under_texel(notes), under_texel);
          ASSERT_EQ(notes_narrow(notes), narrow);
          ASSERT_EQ(notes_refusal(notes), refusal);
        }
      }
    }
  }
}

}  // namespace
}  // namespace penumbra::glsl

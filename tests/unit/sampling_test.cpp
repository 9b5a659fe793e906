#include "shadow/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace penumbra::shadow {
namespace {

TEST(Sampling, RadicalInverseMirrorsBits) {
  EXPECT_EQ(radical_inverse_2(0), 0.0f);
  EXPECT_EQ(radical_inverse_2(1), 0.5f);
  EXPECT_EQ(radical_inverse_2(2), 0.25f);
  EXPECT_EQ(radical_inverse_2(6), 0.375f);
}

TEST(Sampling, PointsLieInTheirShapeAndAreBalanced) {
  for (const char* pattern : {"vogel", "hammersley"}) {
    for (const int count : {1, 7, 16, 64, 256}) {
      glm::vec2 mean{0};
      const std::vector<glm::vec2> disc = disc_points(pattern, count);
      ASSERT_EQ(disc.size(), static_cast<size_t>(count));
      for (const glm::vec2& p : disc) {
        EXPECT_LE(glm::length(p), 1.00001f);
        mean += p / static_cast<float>(count);
      }
      if (count >= 16) {
        EXPECT_LT(glm::length(mean), 0.1f) << pattern << ' ' << count;
      }
      for (const glm::vec2& u : square_points(pattern, count)) {
        EXPECT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1);
      }
    }
  }
}

TEST(Sampling, DiscPointsAreSpreadByArea) {
  // Half of the points lie in the inner half of the area.
  for (const char* pattern : {"vogel", "hammersley"}) {
    int inner = 0;
    for (const glm::vec2& p : disc_points(pattern, 256)) inner += glm::length(p) < std::sqrt(0.5f) ? 1 : 0;
    EXPECT_NEAR(inner, 128, 4) << pattern;
  }
}

}  // namespace
}  // namespace penumbra::shadow

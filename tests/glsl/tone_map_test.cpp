#include "lib/tone_map.glsl"

#include <gtest/gtest.h>

#include <cmath>

namespace penumbra::test {
namespace {

TEST(ToneMap, BrighterLightNeverGetsDarker) {
  float last = -1;
  for (int i = 0; i <= 4000; ++i) {
    const float v = std::exp2(static_cast<float>(i) / 200.0f - 12.0f);  // 2^-12 to 2^8
    const float shown = glsl::srgb_encode(glsl::tone_map(glm::vec3(v)).g);
    EXPECT_GE(shown, last) << v;
    last = shown;
  }
  EXPECT_GT(last, 0.99f);
}

TEST(ToneMap, BlackStaysBlackAndGreyGrey) {
  EXPECT_NEAR(glsl::tone_map(glm::vec3(0)).g, 0.0f, 1e-4f);
  const glm::vec3 grey = glsl::tone_map(glm::vec3(0.18f));
  EXPECT_NEAR(grey.g, 0.18f, 0.03f);
  EXPECT_NEAR(grey.r, grey.b, 2e-3f);
  EXPECT_NEAR(grey.r, grey.g, 2e-3f);
}

TEST(ToneMap, EncodesAsSrgb) {
  EXPECT_FLOAT_EQ(glsl::srgb_encode(0), 0);
  EXPECT_NEAR(glsl::srgb_encode(1), 1, 1e-6f);
  EXPECT_NEAR(glsl::srgb_encode(0.2140411f), 0.5f, 1e-5f);
  EXPECT_NEAR(glsl::srgb_encode(0.001f), 0.01292f, 1e-7f);
}

}  // namespace
}  // namespace penumbra::test

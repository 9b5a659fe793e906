#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "gl/context.h"

namespace penumbra::test {

// Expects two masks from one machine to be equal. A software rasteriser must give the same bits. A GPU may round
// differently in another shader stage: 99.9 % of the pixels must be within 1/255, and all within two of `taps`.
inline void expect_same_visibility(const std::vector<float>& a, const std::vector<float>& b, int taps) {
  ASSERT_EQ(a.size(), b.size());
  if (gl::device_info().software) {
    EXPECT_EQ(a, b);
    return;
  }
  std::size_t apart = 0;
  float greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const float difference = std::abs(a[i] - b[i]);
    apart += difference > 1.0f / 255 ? 1 : 0;
    greatest = std::fmax(greatest, difference);
  }
  EXPECT_LE(apart, a.size() / 1000) << "of " << a.size() << " pixels";
  EXPECT_LE(greatest, 2.0f / static_cast<float>(taps));
}

}  // namespace penumbra::test

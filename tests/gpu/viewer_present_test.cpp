// How the viewer puts pictures into its window.
#include "viewer/present.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/gpu_test.h"

namespace penumbra::test {
namespace {

constexpr int side = 64, channels = 4;

class ViewerPresent : public GpuTest {
 protected:
  // Black below a line through the middle that rises by `slope` pixels a column, white above it, without any grey.
  void draw_stairs(float slope) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const float line = side * 0.5f + slope * (static_cast<float>(x) - side * 0.5f);
        const std::uint8_t value = static_cast<float>(y) > line ? 255 : 0;
        pixels.insert(pixels.end(), {value, value, value, 255});
      }
    }
    picture_.upload(GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(pixels)));
  }

  // The red of each pixel of the window.
  std::vector<float> shown(bool rough, int window = side) {
    if (rough) viewer::smooth_edges(device_, picture_, smooth_);
    const viewer::PresentInputs inputs{
        .a = rough ? &smooth_ : &picture_, .picture_size = {window, window}, .window_size = {window, window}};
    const std::vector<float> all = gl::read_floats(viewer::present(device_, inputs), channels);
    std::vector<float> red;
    for (std::size_t i = 0; i < all.size(); i += channels) red.push_back(all[i]);
    return red;
  }

  static std::ptrdiff_t greys(const std::vector<float>& values) {
    return std::ranges::count_if(values, [](float value) { return value > 0.1f && value < 0.9f; });
  }

  gl::Device device_{gl::ShaderFiles{}, gl::Timers::Mode::off};
  gl::Texture picture_{"picture", {.width = side, .height = side}};
  gl::Texture smooth_{"smooth", {.width = side, .height = side}};
};

TEST_F(ViewerPresent, TheStairsOfAnEdgeGetIntermediateLevels) {
  for (const float slope : {0.15f, 0.4f, 0.9f, -0.3f}) {
    SCOPED_TRACE(slope);
    draw_stairs(slope);
    const std::vector<float> rough = shown(/*rough=*/false), smooth = shown(/*rough=*/true);
    EXPECT_EQ(greys(rough), 0);
    EXPECT_GT(greys(smooth), side / 2);
    // Away from the edge nothing changes, and the edge stays where it is.
    double moved = 0;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const auto at = static_cast<std::size_t>(y * side + x);
        const float line = side * 0.5f + slope * (static_cast<float>(x) - side * 0.5f);
        if (std::abs(static_cast<float>(y) - line) > 3) {
          ASSERT_EQ(smooth[at], rough[at]) << x << ", " << y;
        }
        moved += smooth[at] - rough[at];
      }
    }
    EXPECT_LT(std::abs(moved), 0.1 * side) << "pixels";
  }
}

TEST_F(ViewerPresent, StraightEdgesStaySharp) {
  draw_stairs(0);
  EXPECT_EQ(shown(true), shown(false));
}

TEST_F(ViewerPresent, ASmallPictureIsInterpolated) {
  draw_stairs(0);
  EXPECT_GT(greys(shown(false, 4 * side)), 4 * side);
}

}  // namespace
}  // namespace penumbra::test

// How the viewer puts pictures into its window.
#include "viewer/present.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <span>
#include <vector>

#include "gpu/gpu_test.h"

namespace penumbra::test {
namespace {

constexpr int side = 64, channels = 4;

class ViewerPresent : public GpuTest {
 protected:
  // A grey picture by a function of the pixel's column and row.
  template <class Value>
  void draw_grey(Value value_at) {
    std::vector<std::uint8_t> pixels;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const std::uint8_t value = value_at(x, y);
        pixels.insert(pixels.end(), {value, value, value, 255});
      }
    }
    picture_.upload(GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(pixels)));
  }

  static bool is_above(float slope, int x, int y) {
    return static_cast<float>(y) > side * 0.5f + slope * (static_cast<float>(x) - side * 0.5f);
  }

  // Black below a line through the middle that rises by `slope` pixels a column, white above it, without any grey.
  void draw_stairs(float slope) {
    draw_grey([&](int x, int y) { return is_above(slope, x, y) ? 255 : 0; });
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

// Beside a white wall, pixels are smoothed along an edge between greys, but not with the white.
TEST_F(ViewerPresent, TheStairsOfAnEdgeTakeNothingOfWhatIsAtItsEnd) {
  constexpr int wall = 40, reach = 3;  // columns
  for (const float slope : {0.05f, 0.15f, -0.3f}) {
    SCOPED_TRACE(slope);
    draw_grey([&](int x, int y) { return x >= wall ? 255 : is_above(slope, x, y) ? 153 : 102; });
    const std::vector<float> smooth = shown(/*rough=*/true);
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < wall - reach; ++x)
        ASSERT_LE(smooth[static_cast<std::size_t>(y * side + x)], 0.6f + 1e-6f) << x << ", " << y;
  }
}

TEST_F(ViewerPresent, ASmallPictureIsInterpolated) {
  draw_stairs(0);
  EXPECT_GT(greys(shown(false, 4 * side)), 4 * side);
}

// Two pictures of one colour each, as large as the window.
class ViewerComparison : public GpuTest {
 protected:
  ViewerComparison() {
    fill(first_, {200, 40, 0});
    fill(second_, {190, 60, 0});
    fill(blue_, {0, 0, 200});
  }

  static void fill(const gl::Texture& texture, const glm::u8vec3& color) {
    const std::vector<glm::u8vec4> pixels(side * side, {color, 255});
    texture.upload(GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(pixels)));
  }

  // Of 255, at a column of the window.
  glm::vec3 shown(int x, const viewer::PresentInputs& how) {
    viewer::PresentInputs inputs = how;
    inputs.a = &first_;
    inputs.b = &second_;
    inputs.picture_size = inputs.window_size = {side, side};
    inputs.comparison.on = true;
    const std::vector<float> all = gl::read_floats(viewer::present(device_, inputs), 3);
    const std::size_t at = 3 * static_cast<std::size_t>(side / 2 * side + x);
    return glm::round(255.0f * glm::vec3(all.at(at), all.at(at + 1), all.at(at + 2)));
  }

  gl::Device device_{gl::ShaderFiles{}, gl::Timers::Mode::off};
  gl::Texture first_{"first", {.width = side, .height = side}}, second_{"second", {.width = side, .height = side}};
  gl::Texture blue_{"blue", {.width = side, .height = side}};
  const glm::vec3 a_{200, 40, 0}, b_{190, 60, 0};
};

TEST_F(ViewerComparison, AWipeShowsTheSecondPictureFromItsPlaceOn) {
  const viewer::PresentInputs inputs{.comparison = {.how = viewer::CompareMode::wipe, .wipe = 0.25f}};
  EXPECT_EQ(shown(15, inputs), a_);
  EXPECT_EQ(shown(16, inputs), b_);
}

TEST_F(ViewerComparison, SideBySideTheFirstPictureIsOnTheLeft) {
  const viewer::PresentInputs inputs{.comparison = {.how = viewer::CompareMode::side_by_side}};
  for (const int x : {0, 31}) EXPECT_EQ(shown(x, inputs), a_) << x;
  for (const int x : {32, 63}) EXPECT_EQ(shown(x, inputs), b_) << x;
}

TEST_F(ViewerComparison, ADifferenceIsMultipliedByItsGain) {
  const viewer::PresentInputs inputs{.comparison = {.how = viewer::CompareMode::difference, .gain = 4}};
  EXPECT_EQ(shown(20, inputs), 4.0f * glm::abs(a_ - b_));
}

TEST_F(ViewerComparison, ATintIsMixedIntoItsOwnPicture) {
  const glm::vec3 tinted = glm::round(glm::mix(a_, {0, 0, 200}, 0.45f));
  viewer::PresentInputs inputs{.tint_a = &blue_, .comparison = {.how = viewer::CompareMode::a}};
  EXPECT_EQ(shown(20, inputs), tinted);
  inputs.comparison = {.how = viewer::CompareMode::wipe, .wipe = 0.5f};
  EXPECT_EQ(shown(20, inputs), tinted);
  EXPECT_EQ(shown(40, inputs), b_);
}

}  // namespace
}  // namespace penumbra::test

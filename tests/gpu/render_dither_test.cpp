// Rounding of pictures to 8 bits.
#include <algorithm>
#include <cmath>

#include "gpu/gpu_test.h"
#include "lib/tone_map.glsl"
#include "render/passes.h"

namespace penumbra::test {
namespace {

class Dither : public GpuTest {
 protected:
  // Bytes of the red channel of a picture of one shade.
  std::vector<double> drawn(float shade, bool dithered) {
    constexpr int side = 64;
    gl::Device device({}, gl::Timers::Mode::off);
    gl::Texture lit("lit", {.format = GL_RGBA32F, .width = side, .height = side});
    const std::vector<glm::vec4> texels(side * side, glm::vec4(glm::vec3(shade), 1));
    lit.upload(GL_RGBA, GL_FLOAT, std::as_bytes(std::span(texels)));
    const gl::Buffer& exposure = device.scratch("exposure", sizeof(float));
    gl::write_value(exposure, 1.0f);
    ParamSet params(render::render_params());
    params.set("render.dither", dithered);
    const gl::Texture noise = render::dither_noise();
    const gl::Texture& display =
        render::tone_map(device, {.lit = lit, .exposure = exposure, .noise = noise, .params = params});
    std::vector<double> bytes;
    const std::vector<float> rgb = gl::read_floats(display, 3);
    std::size_t tinted = 0;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
      tinted += rgb[i] != rgb[i + 1] || rgb[i] != rgb[i + 2] ? 1 : 0;
      bytes.push_back(255.0 * rgb[i]);
    }
    // The tone map's matrices leave grey to about 1e-5.
    EXPECT_LE(tinted, bytes.size() / 50) << "grey stays grey";
    return bytes;
  }
};

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

TEST_F(Dither, TheMeanOfAnAreaIsTheShadeThatWasAskedFor) {
  for (const float shade : {0.0131f, 0.171f, 0.1717f, 0.1725f, 0.45f}) {
    const double exact = 255.0 * glsl::srgb_encode(glsl::tone_map(glm::vec3(shade)).r);
    const std::vector<double> dithered = drawn(shade, true), rounded = drawn(shade, false);
    EXPECT_NEAR(mean(dithered), exact, 0.01) << shade;
    const auto [low, high] = std::ranges::minmax(dithered);
    EXPECT_LE(high - low, 1.001) << "no more than the two nearest values";
    for (const double byte : rounded) ASSERT_NEAR(byte, std::round(exact), 1e-3);
  }
}

TEST_F(Dither, BlackStaysBlack) {
  for (const double byte : drawn(0, true)) ASSERT_EQ(byte, 0);
}

}  // namespace
}  // namespace penumbra::test

// Automatic exposure against its closed form: the geometric mean of what a white surface would show at each pixel.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/gtc/constants.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

#include "render/passes.h"
#include "render_scenes.h"

namespace penumbra::test {
namespace {

struct Pixel {
  float radiance = 0, root_of_albedo = 1, alpha = 1;  // alpha 0: sky
};

class Exposure : public GpuTest {
 protected:
  // The exposure of a picture of that size. `stops`: added to it.
  template <class PixelAt>
  float measured(int width, int height, PixelAt pixel_at, float stops = 0) {
    std::vector<glm::vec4> lit, albedo;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Pixel pixel = pixel_at(x, y);
        lit.emplace_back(glm::vec3(pixel.radiance), 1);
        albedo.emplace_back(glm::vec3(pixel.root_of_albedo), pixel.alpha);
      }
    }
    gl::Device device({}, gl::Timers::Mode::off);
    const auto texture_of = [&](const char* name, const std::vector<glm::vec4>& texels) {
      gl::Texture texture(name, {.format = GL_RGBA32F, .width = width, .height = height});
      texture.upload(GL_RGBA, GL_FLOAT, std::as_bytes(std::span(texels)));
      return texture;
    };
    const gl::Texture light = texture_of("lit", lit), roots = texture_of("albedo", albedo);
    render::GBuffer gbuffer;
    gbuffer.albedo = &roots;
    ParamSet params(render::render_params());
    params.set("exposure.compensation", stops);
    const gl::Buffer& buffer = render::measure_exposure(device, {.gbuffer = gbuffer, .lit = light, .params = params});
    float exposure = 0;
    gl::glGetNamedBufferSubData(buffer.id(), 0, sizeof(exposure), &exposure);
    return exposure;
  }
};

// Sizes of one work group, of a part of one, and of many whose last one is not full.
TEST_F(Exposure, IsThatOfTheGeometricMeanWhateverTheSize) {
  for (const auto& [width, height] : {std::pair(8, 8), {180, 180}, {400, 300}, {1283, 717}}) {
    // White is to have the value 1: samples of 1/4 and of 1 have the mean 1/2.
    std::size_t samples = 0, bright = 0;
    const float exposure = measured(width, height, [&](int x, int y) {
      const bool is_bright = y >= height / 3;
      if (x % 4 == 0 && y % 4 == 0) {
        ++samples;
        bright += is_bright ? 1 : 0;
      }
      return Pixel{.radiance = is_bright ? 1.0f : 0.25f};
    });
    const double share = static_cast<double>(bright) / static_cast<double>(samples);
    EXPECT_NEAR(exposure, std::pow(4.0, 1 - share), 1e-4) << width << " x " << height;
  }
}

TEST_F(Exposure, LeavesOutTheSkyAndWhatAlbedoDoes) {
  const float exposure = measured(400, 300, [](int x, int y) {
    if (y > 200) return Pixel{.radiance = 50, .alpha = 0};
    return x < 200 ? Pixel{.radiance = 0.25f, .root_of_albedo = 0.5f} : Pixel{.radiance = 0.5f, .root_of_albedo = 1};
  });
  // 1/4 over an albedo of 1/4, and 1/2 over 1.
  EXPECT_NEAR(exposure, std::sqrt(2.0f), 1e-4);
}

TEST_F(Exposure, LeavesOutUnlitSurfaces) {
  const float exposure = measured(400, 300, [](int x, int /*y*/) {
    return x < 200 ? Pixel{.radiance = 0.5f} : Pixel{.radiance = 0.25f, .alpha = 1.0f / 3.0f};
  });
  EXPECT_NEAR(exposure, 2, 1e-4);
}

TEST_F(Exposure, IsTwiceAsBrightWithOneMoreStop) {
  const auto grey = [](int, int) { return Pixel{.radiance = 0.25f}; };
  const float usual = measured(64, 64, grey);
  EXPECT_FLOAT_EQ(measured(64, 64, grey, 1), 2 * usual);
  EXPECT_FLOAT_EQ(measured(64, 64, grey, -2), usual / 4);
}

TEST_F(Exposure, IsLimitedInDarkPicturesAndBrightOnes) {
  for (const float radiance : {0.0f, 0.02f, 0.1f})
    EXPECT_FLOAT_EQ(measured(64, 64, [&](int, int) { return Pixel{.radiance = radiance}; }), 6) << radiance;
  for (const float radiance : {2.0f, 10.0f, 60000.0f})
    EXPECT_FLOAT_EQ(measured(64, 64, [&](int, int) { return Pixel{.radiance = radiance}; }), 0.7f) << radiance;
}

TEST_F(Exposure, CountsBlackAndDazzlingPixelsAsAThousandthAndAHundred) {
  const auto with = [&](float radiance, int columns) {
    return measured(64, 64, [&](int x, int) { return Pixel{.radiance = x < columns ? radiance : 1}; });
  };
  EXPECT_NEAR(with(0, 16), std::pow(1e3, 0.25), 1e-4);
  EXPECT_NEAR(with(60000, 4), std::pow(1e-2, 1.0 / 16), 1e-4);
}

TEST_F(Exposure, TakesNoAlbedoForLessThanATwentieth) {
  for (const float root : {0.0f, 0.1f})
    EXPECT_NEAR(measured(64, 64, [&](int, int) { return Pixel{.radiance = 0.05f, .root_of_albedo = root}; }), 1, 1e-4);
}

// As ADR 32 has it, of ground that fills the picture, at noon and in the evening.
TEST_F(RenderTest, SunlitSurfacesAreDisplayedByTheirAlbedo) {
  inputs.camera = inputs.last_camera = render::look_at({0, 2, 2}, {0, 0, 0}, 0.6f, 0.01f);
  const glm::mat4 level = glm::rotate(glm::scale(glm::mat4(1), glm::vec3(50)), -glm::half_pi<float>(), {1, 0, 0});
  for (const auto& [albedo, expected] : {std::pair(0.5f, 189), {0.18f, 118}}) {
    scene::Scene ground;
    ground.materials = {{.base_color = {albedo, albedo, albedo, 1}, .metallic = 0, .roughness = 1}};
    scene::Primitive plane = square();
    plane.material = 0;
    add_node(ground, std::move(plane), level);
    for (const float elevation : {0.5f, 1.2f}) {
      sun().to_light = {0, std::sin(elevation), std::cos(elevation)};
      draw(ground);
      const std::vector<std::uint8_t> shown = renderer.read_display();
      const std::size_t middle = 3 * (height / 2 * width + width / 2);
      // Sun and sky have colours, whose mean is grey.
      const int sum = shown[middle] + shown[middle + 1] + shown[middle + 2];
      EXPECT_NEAR(sum / 3.0, expected, 3) << albedo << ", the sun at " << elevation;
    }
  }
}

}  // namespace
}  // namespace penumbra::test

// Three places of scenes/courtyard.glb under the real sun that show at 400 % what a whole picture's figures hide,
// against rays: the shadow under the string course, whose edge may get saw-teeth, the slots of the shutters, where
// light may leak in, and the line where the fountain touches its step, which may be dotted.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "image/read.h"
#include "image/sun_rays.h"
#include "render/renderer.h"
#include "render/setup.h"
#include "scene/gltf.h"
#include "scene/pose.h"

namespace penumbra::test {
namespace {

constexpr int width = 1280, height = 720;

// A rectangle of pixels, and how far its visibility may be from that of 256 rays a pixel.
struct Crop {
  const char* name;
  glm::ivec2 first, size;
  double rmse;
  int wrong;    // pixels by more than a half
  double bias;  // of the mean, either way
};

const std::vector<Crop> crops{{"under the string course", {660, 165}, {180, 60}, 0.034, 4, 0.002},
                              {"slots of the shutters", {755, 68}, {150, 105}, 0.052, 42, 0.002},
                              {"foot of the fountain", {420, 500}, {240, 80}, 0.0195, 3, 0.002}};

struct Maps {
  const char* fit;
  int size = 2048;  // texels of each side
};

struct Error {
  double rmse = 0, bias = 0;
  int wrong = 0;
};

class CourtyardCrops : public GpuTest {
 protected:
  CourtyardCrops() {
    setup_ = render::choose_setup(scene_, scene::pose_at(scene_, 0),
                                  {{}, render::GroundChoice::automatic, static_cast<float>(width) / height});
    draw("sun_rays", {.fit = "visible"});
    for (const Crop& crop : crops) truth_.push_back(rays_.visibility(crop.first, crop.size, 256));
  }

  void draw(const std::string& technique, const Maps& maps) {
    ParamSet params(render::Renderer::params(renderer_.registry()));
    renderer_.registry().select(params, technique);
    params.set_text("cascades.fit", maps.fit);
    params.set("cascades.size", maps.size);
    params.set("sun.angle", 0.53f);
    renderer_.draw(gpu_scene_,
                   {.width = width,
                    .height = height,
                    .camera = setup_.camera,
                    .last_camera = setup_.camera,
                    .lights = {setup_.sun},
                    .cut = true},
                   params);
  }

  // Of each crop, by the technique that draws where none is named.
  std::vector<Error> errors(const Maps& maps) {
    draw("slices_denoised", maps);
    const std::vector<float> picture = renderer_.read_aov("shadow");
    std::vector<Error> all;
    for (std::size_t i = 0; i < crops.size(); ++i) {
      const Crop& crop = crops[i];
      Error error;
      for (std::size_t at = 0; at < truth_[i].size(); ++at) {
        const glm::ivec2 pixel =
            crop.first + glm::ivec2(static_cast<int>(at) % crop.size.x, static_cast<int>(at) / crop.size.x);
        const double off = picture[static_cast<std::size_t>(pixel.y * width + pixel.x)] - truth_[i][at];
        error.rmse += off * off;
        error.bias += off;
        error.wrong += std::abs(off) > 0.5 ? 1 : 0;
      }
      error.rmse = std::sqrt(error.rmse / static_cast<double>(truth_[i].size()));
      error.bias /= static_cast<double>(truth_[i].size());
      std::printf("%s, %s maps of %d: RMSE %.4f, bias %+.4f, %d of %zu pixels wrong\n", crop.name, maps.fit, maps.size,
                  error.rmse, error.bias, error.wrong, truth_[i].size());
      all.push_back(error);
    }
    return all;
  }

  SunRays rays_;
  gl::Device device_{gl::ShaderFiles(), gl::Timers::Mode::off};
  render::Renderer renderer_{device_, rays_.registry()};
  scene::Scene scene_ = scene::read_gltf(PENUMBRA_ROOT "/scenes/courtyard.glb", image::image_decoder());
  scene::GpuScene gpu_scene_{device_, scene_};
  render::Setup setup_;
  std::vector<std::vector<float>> truth_;
};

TEST_F(CourtyardCrops, AreNearTheTruthWithMapsFittedToThePicture) {
  const std::vector<Error> fitted = errors({.fit = "visible"}), stable = errors({.fit = "stable"});
  const std::vector<Error> fine = errors({.fit = "visible", .size = 4096});
  for (std::size_t i = 0; i < crops.size(); ++i) {
    SCOPED_TRACE(crops[i].name);
    EXPECT_LE(fitted[i].rmse, crops[i].rmse);
    EXPECT_LE(fitted[i].wrong, crops[i].wrong);
    EXPECT_LE(std::abs(fitted[i].bias), crops[i].bias);
    // Maps of two thirds of the resolution do not reach that, so these bounds tell them apart.
    EXPECT_GT(stable[i].rmse, crops[i].rmse);
    // What is left is the maps' resolution, and no fault of the technique: it goes as texels get smaller.
    EXPECT_LE(fine[i].rmse, 0.65 * fitted[i].rmse);
    EXPECT_LE(fine[i].wrong, std::max(fitted[i].wrong / 2, 1));
  }
}

}  // namespace
}  // namespace penumbra::test

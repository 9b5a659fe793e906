// Figures 2.11 and 2.12: noise that differs from pixel to pixel, and pictures that are dithered with it and then
// blurred.

#include "metrics/convolve.h"
#include "metrics/error_figures.h"
#include "report/number.h"
#include "reproduce/crops.h"
#include "reproduce/figures.h"
#include "reproduce/spectrum.h"
#include "shadow/noise.h"

namespace penumbra::reproduce {

namespace {

std::vector<float> channel_of(const shadow::NoiseTile& tile, int channel) {
  std::vector<float> values;
  for (int pixel = 0; pixel < tile.count(); ++pixel) values.push_back(tile.value(pixel, channel));
  return values;
}

// Mean of both channels.
Quantity low_to_high(const char* kind, const std::string& name) {
  const shadow::NoiseTile tile = shadow::built_in_noise(kind);
  double sum = 0;
  for (int channel = 0; channel < tile.channels; ++channel) sum += shadow::low_to_high_power(tile, channel);
  return {"the ratio of low to high frequencies of " + name, sum / tile.channels, "", 3};
}

std::vector<report::Tile> noise_tiles(const char* kind, const std::string& name) {
  constexpr float brightest = 4;  // times the mean power
  const shadow::NoiseTile noise = shadow::built_in_noise(kind);
  const std::vector<float> values = channel_of(noise, 0);
  std::vector<float> power = power_spectrum(values, noise.size);
  for (float& value : power) value /= brightest;
  return {tile(name, "first of two channels, 64 × 64 pixels", enlarged(values, noise.size, noise.size)),
          tile("Its power spectrum", "frequency 0 in the middle; white is four times the mean",
               enlarged(power, noise.size, noise.size))};
}

// ---- Dither ----

constexpr int ramp_width = 192, ramp_height = 96;
constexpr double blur_sigma = 1.5;

metrics::Plane ramp() {
  metrics::Plane plane(ramp_width, ramp_height);
  for (int y = 0; y < ramp_height; ++y) {
    for (int x = 0; x < ramp_width; ++x) plane.row(y)[x] = (static_cast<float>(x) + 0.5f) / ramp_width;
  }
  return plane;
}

metrics::Plane dithered(const metrics::Plane& plane, const shadow::NoiseTile& noise) {
  metrics::Plane result = plane;
  for (int y = 0; y < plane.height; ++y) {
    for (int x = 0; x < plane.width; ++x) {
      const int pixel = y % noise.size * noise.size + x % noise.size;
      result.row(y)[x] = plane.row(y)[x] > noise.value(pixel, 0) ? 1.0f : 0.0f;
    }
  }
  return result;
}

metrics::Plane blurred(const metrics::Plane& plane) {
  return metrics::blurred(plane, blur_sigma, metrics::Border::nearest);
}

Quantity psnr(const std::string& name, const metrics::Plane& test, const metrics::Plane& reference) {
  const auto picture = [](const metrics::Plane& plane) {
    return metrics::ImageView{.width = plane.width, .height = plane.height, .pixels = plane.pixels};
  };
  return {name, metrics::error_figures(picture(test), picture(reference)).psnr, "dB"};
}

report::Tile plane_tile(const std::string& title, const Quantity& quantity, const metrics::Plane& plane) {
  return tile(title, "PSNR " + quantity.text(), enlarged(plane.pixels, plane.width, plane.height));
}

}  // namespace

Finding figure_2_11(Workbench&) {
  Finding finding;
  finding.id = "2.11";
  finding.title = "White and blue noise";
  finding.claim = "Blue noise, made from white by swaps of pixels, has weak low frequencies (section 2.6.2).";
  finding.test =
      "Mean power below 1/8 cycle a pixel over that from 0.35 to 0.5, of both channels; white noise has about 1. The "
      "claim holds if blue noise has less than half of white noise's. Our tile is 64 × 64 pixels, as the thesis's own "
      "renderer uses; its figure shows 256 × 256.";
  finding.body = report::tiles(noise_tiles("white", "White noise"));
  finding.body.add(report::tiles(noise_tiles("blue", "Blue noise")));
  const Quantity white = low_to_high("white", "white noise"), blue = low_to_high("blue", "blue noise");
  finding.record(white);
  finding.expect_below(blue, {"half of white noise's", white.value / 2, "", 3});
  finding.record(low_to_high("void_and_cluster", "void-and-cluster noise"));
  return finding;
}

Finding figure_2_12(Workbench&) {
  const metrics::Plane original = ramp(), reference = blurred(original);
  Finding finding;
  finding.id = "2.12";
  finding.title = "Dither by noise, and the same after a blur";
  finding.claim = "What was dithered by blue noise is easier to denoise, and looks better even before.";
  finding.test =
      "A ramp dithered to black and white, against the ramp; and both through a Gaussian of 1.5 pixels. Before the "
      "blur the PSNR is about the same by nature: each pixel is black or white. After it, blue must be better.";
  std::vector<report::Tile> sharp, soft;
  std::vector<Quantity> after;
  for (const auto& [kind, name] : {std::pair{"white", "white noise"}, std::pair{"blue", "blue noise"}}) {
    const metrics::Plane picture = dithered(original, shadow::built_in_noise(kind));
    const metrics::Plane smooth = blurred(picture);
    const Quantity before = psnr("the PSNR of " + std::string(name), picture, original);
    after.push_back(psnr("the PSNR after a blur of " + std::string(name), smooth, reference));
    finding.record(before);
    sharp.push_back(plane_tile(std::string("Dithered by ") + name, before, picture));
    soft.push_back(plane_tile("After a Gaussian of 1.5 pixels", after.back(), smooth));
  }
  finding.body = report::tiles(sharp).add(report::tiles(soft));
  finding.expect_above(after[1], after[0]);
  return finding;
}

}  // namespace penumbra::reproduce

#include "compare/pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "image/packed.h"
#include "image/write.h"
#include "render/aov_picture.h"

namespace penumbra::compare {

namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr Rgb no_receiver{72, 75, 82};
// From too dark to too bright by way of white, with lightness that falls equally on both sides (ColorBrewer's RdBu, by
// Cynthia Brewer).
constexpr std::array<Rgb, 7> ramp{{{33, 102, 172},
                                   {103, 169, 207},
                                   {209, 229, 240},
                                   {247, 247, 247},
                                   {253, 219, 199},
                                   {239, 138, 98},
                                   {178, 24, 43}}};

// `error` in units of the full scale.
Rgb colour_of(float error) {
  if (std::isnan(error)) return no_receiver;
  const float place = (std::clamp(error, -1.0f, 1.0f) + 1.0f) * 0.5f * static_cast<float>(ramp.size() - 1);
  const auto index = std::min(static_cast<std::size_t>(place), ramp.size() - 2);
  const float share = place - static_cast<float>(index);
  Rgb colour{};
  for (std::size_t i = 0; i < 3; ++i) {
    const float mixed = std::lerp(static_cast<float>(ramp[index][i]), static_cast<float>(ramp[index + 1][i]), share);
    colour[i] = static_cast<std::uint8_t>(std::lround(mixed));
  }
  return colour;
}

std::string text_of(const Rgb& colour) { return fmt::format("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]); }

report::EncodedPicture encoded(const std::vector<std::uint8_t>& pixels, int channels, const cli::Size& size) {
  return report::make_picture(image::encode_png(size.width, size.height, channels, pixels), size.width, size.height);
}

// Of the masks of all lights, one below the other, with so many pixels.
cli::Size size_of_masks(std::size_t pixels, const cli::Size& size) {
  return {.width = size.width, .height = static_cast<int>(pixels / static_cast<std::size_t>(size.width))};
}

}  // namespace

ComparedPictures encoded_pictures(const std::vector<std::uint8_t>& display, const std::vector<float>& visibility,
                                  const cli::Size& size) {
  const render::ByteImage bytes = render::aov_bytes("shadow", 1, visibility);
  return {.display = encoded(display, 3, size),
          .visibility = encoded(bytes.pixels, bytes.channels, size_of_masks(visibility.size(), size)),
          .error = {}};
}

float error_scale(const ComparedScene& scene) {
  double best = 1;
  for (const ComparedTechnique& technique : scene.techniques) {
    // A contender that equals the reference does not count: its error is 0.
    if (technique.figures.p99 > 0) best = std::min(best, technique.figures.p99);
  }
  for (const float scale : {0.05f, 0.1f, 0.2f, 0.5f}) {
    if (best <= scale) return scale;
  }
  return 1.0f;
}

report::ErrorMap error_map(const ComparedPictures& pictures, const std::string& technique, float scale) {
  const cli::Size size{.width = pictures.visibility.width, .height = pictures.visibility.height};
  const std::vector<float> errors = image::unpack_floats(
      pictures.error, static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
  std::vector<std::uint8_t> pixels, codes;
  pixels.reserve(errors.size() * 3);
  codes.reserve(errors.size());
  for (const float error : errors) {
    const Rgb colour = colour_of(error / scale);
    pixels.insert(pixels.end(), colour.begin(), colour.end());
    codes.push_back(report::error_code(error));
  }
  report::ErrorMap map{.figure = {.label = {},
                                  .alt = fmt::format("Where {} is too bright or too dark", technique),
                                  .picture = encoded(pixels, 3, size)},
                       .legend = {.title = "Visibility minus the reference's; dark grey: not measured",
                                  .colours = {},
                                  .labels = {"−{} too dark", "0", "+{} too bright"}},
                       .codes = encoded(codes, 1, size),
                       .unmeasured = text_of(no_receiver),
                       .range = scale};
  for (const Rgb& colour : ramp) map.legend.colours.push_back(text_of(colour));
  return map;
}

}  // namespace penumbra::compare

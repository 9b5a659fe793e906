#include "app/picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

namespace penumbra::app {

namespace {

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

// IEC 61966-2-1.
float srgb_to_linear(float v) { return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f); }
float linear_to_srgb(float v) { return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f; }

const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
    return values;
  }();
  return table;
}

std::size_t index_of(int x, int y, int width, int channels) {
  return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
         static_cast<std::size_t>(channels);
}

std::size_t pixel_values(int width, int height, int channels) { return index_of(0, height, width, channels); }

// Each value of `pixels` as a byte, `encode` deciding how.
template <class Encode>
Bytes each(int channels, const std::vector<float>& pixels, Encode encode) {
  Bytes bytes{channels, std::vector<std::uint8_t>(pixels.size())};
  std::transform(pixels.begin(), pixels.end(), bytes.pixels.begin(), [&](float v) { return to_byte(encode(v)); });
  return bytes;
}

Bytes depth_bytes(const std::vector<float>& depths) {
  std::vector<float> seen;
  std::copy_if(depths.begin(), depths.end(), std::back_inserter(seen),
               [](float z) { return std::isfinite(z) && z > 0; });
  if (seen.empty()) return each(1, depths, [](float) { return 0.0f; });
  const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
  std::nth_element(seen.begin(), middle, seen.end());
  return each(1, depths,
              [median = *middle](float z) { return std::isfinite(z) && z > 0 ? median / (median + z) : 0.0f; });
}

Bytes relative_bytes(int channels, const std::vector<float>& pixels, bool is_signed) {
  float largest = 0;
  for (const float v : pixels) {
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  }
  const float scale = largest > 0 ? 1.0f / largest : 0.0f;
  return each(channels, pixels, [=](float v) { return is_signed ? 0.5f + 0.5f * v * scale : v * scale; });
}

Bytes cascade_bytes(int channels, const std::vector<float>& pixels) {
  static constexpr std::array<std::array<std::uint8_t, 3>, 8> colors{{{{214, 69, 65}},
                                                                      {{84, 160, 72}},
                                                                      {{66, 110, 196}},
                                                                      {{222, 180, 60}},
                                                                      {{150, 84, 170}},
                                                                      {{60, 176, 180}},
                                                                      {{226, 128, 52}},
                                                                      {{150, 150, 150}}}};
  Bytes bytes{3, {}};
  for (std::size_t i = 0; i < pixels.size(); i += static_cast<std::size_t>(channels)) {
    const bool none = !(pixels[i] >= 0);
    const auto color =
        none ? std::array<std::uint8_t, 3>{} : colors[static_cast<std::size_t>(pixels[i]) % colors.size()];
    bytes.pixels.insert(bytes.pixels.end(), color.begin(), color.end());
  }
  return bytes;
}

// PNG has no two-channel colour: the third is middle grey's.
Bytes with_third(const Bytes& two) {
  Bytes three{3, {}};
  for (std::size_t i = 0; i < two.pixels.size(); i += 2)
    three.pixels.insert(three.pixels.end(), {two.pixels[i], two.pixels[i + 1], std::uint8_t{128}});
  return three;
}

}  // namespace

std::vector<float> box_filter(const std::vector<float>& pixels, int width, int height, int channels, int factor) {
  assert(pixels.size() == pixel_values(width * factor, height * factor, channels));
  if (factor == 1) return pixels;
  std::vector<float> means(pixel_values(width, height, channels));
  const double weight = 1.0 / (static_cast<double>(factor) * factor);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        double sum = 0;
        for (int j = 0; j < factor; ++j)
          for (int i = 0; i < factor; ++i)
            sum += pixels[index_of(x * factor + i, y * factor + j, width * factor, channels) +
                          static_cast<std::size_t>(c)];
        means[index_of(x, y, width, channels) + static_cast<std::size_t>(c)] = static_cast<float>(sum * weight);
      }
    }
  }
  return means;
}

std::vector<float> pick_middle(const std::vector<float>& pixels, int width, int height, int channels, int factor) {
  std::vector<float> picked(pixel_values(width, height, channels));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t from = index_of(x * factor + factor / 2, y * factor + factor / 2, width * factor, channels);
      std::copy_n(pixels.begin() + static_cast<std::ptrdiff_t>(from), channels,
                  picked.begin() + static_cast<std::ptrdiff_t>(index_of(x, y, width, channels)));
    }
  }
  return picked;
}

Bytes display_bytes(std::vector<std::uint8_t> rgb, int width, int height, int factor) {
  assert(rgb.size() == pixel_values(width * factor, height * factor, 3));
  if (factor == 1) return {3, std::move(rgb)};
  std::vector<float> linear(rgb.size());
  std::transform(rgb.begin(), rgb.end(), linear.begin(), [](std::uint8_t v) { return linear_of_byte()[v]; });
  return each(3, box_filter(linear, width, height, 3, factor), linear_to_srgb);
}

Bytes aov_bytes(std::string_view name, int channels, const std::vector<float>& pixels) {
  if (name == "cascade") return cascade_bytes(channels, pixels);
  if (name == "depth") return depth_bytes(pixels);
  if (name == "albedo") return each(channels, pixels, linear_to_srgb);
  if (name == "motion") return with_third(relative_bytes(channels, pixels, /* is_signed= */ true));
  if (name.ends_with("normal")) return each(channels, pixels, [](float v) { return 0.5f + 0.5f * v; });
  if (name == "shadow" || name == "material") return each(channels, pixels, [](float v) { return v; });
  return relative_bytes(channels, pixels, /* is_signed= */ false);
}

}  // namespace penumbra::app

#include "render/aov_picture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "lib/tone_map.glsl"
#include "scene/srgb.h"

namespace penumbra::render {

namespace {

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = scene::srgb_decode(static_cast<float>(i) / 255.0f);
    return values;
  }();
  return table;
}

std::size_t index_of(int x, int y, int width, int channels) {
  return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
         static_cast<std::size_t>(channels);
}

std::size_t pixel_values(int width, int height, int channels) { return index_of(0, height, width, channels); }

// Converts each value of `pixels` to a byte by `encode`.
template <class Encode>
ByteImage each(int channels, const std::vector<float>& pixels, Encode encode) {
  ByteImage bytes{channels, std::vector<std::uint8_t>(pixels.size())};
  std::transform(pixels.begin(), pixels.end(), bytes.pixels.begin(), [&](float v) { return to_byte(encode(v)); });
  return bytes;
}

ByteImage depth_bytes(const std::vector<float>& depths) {
  std::vector<float> seen;
  std::copy_if(depths.begin(), depths.end(), std::back_inserter(seen),
               [](float z) { return std::isfinite(z) && z > 0; });
  if (seen.empty()) return each(1, depths, [](float) { return 0.0f; });
  const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
  std::nth_element(seen.begin(), middle, seen.end());
  return each(1, depths,
              [median = *middle](float z) { return std::isfinite(z) && z > 0 ? median / (median + z) : 0.0f; });
}

ByteImage relative_bytes(int channels, const std::vector<float>& pixels, bool is_signed) {
  float largest = 0;
  for (const float v : pixels) {
    if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
  }
  const float scale = largest > 0 ? 1.0f / largest : 0.0f;
  return each(channels, pixels, [=](float v) { return is_signed ? 0.5f + 0.5f * v * scale : v * scale; });
}

ByteImage label_bytes(int channels, const std::vector<float>& pixels) {
  ByteImage bytes{3, {}};
  for (std::size_t i = 0; i < pixels.size(); i += static_cast<std::size_t>(channels)) {
    const std::array<std::uint8_t, 3> color = label_color(pixels[i]);
    bytes.pixels.insert(bytes.pixels.end(), color.begin(), color.end());
  }
  return bytes;
}

// PNG has no two-channel colour, so a third channel of middle grey is added.
ByteImage with_third(const ByteImage& two) {
  ByteImage three{3, {}};
  for (std::size_t i = 0; i < two.pixels.size(); i += 2)
    three.pixels.insert(three.pixels.end(), {two.pixels[i], two.pixels[i + 1], std::uint8_t{128}});
  return three;
}

// The block of source pixels that one result pixel is computed from.
struct Block {
  const std::vector<float>& pixels;
  int width, channels, factor;  // width: of `pixels`
  int x, y;                     // the first

  float at(int i, int j, int channel) const {
    return pixels[index_of(x + i, y + j, width, channels) + static_cast<std::size_t>(channel)];
  }
};

float mean(const Block& block, int channel, bool only_valid) {
  double sum = 0;
  int count = 0;
  for (int j = 0; j < block.factor; ++j) {
    for (int i = 0; i < block.factor; ++i) {
      const float value = block.at(i, j, channel);
      if (only_valid && value == 0) continue;
      sum += value;
      ++count;
    }
  }
  return count == 0 ? 0.0f : static_cast<float>(sum / count);
}

float reduce(const Block& block, int channel, Reduction reduction) {
  switch (reduction) {
    case Reduction::mean:
      return mean(block, channel, /* only_valid= */ false);
    case Reduction::mean_of_valid:
      return mean(block, channel, /* only_valid= */ true);
    case Reduction::nearest_center:
      break;
  }
  return block.at(block.factor / 2, block.factor / 2, channel);
}

}  // namespace

std::vector<float> reduced(const std::vector<float>& pixels, int width, int height, int channels, int factor,
                           Reduction reduction) {
  assert(pixels.size() == pixel_values(width * factor, height * factor, channels));
  if (factor == 1) return pixels;
  std::vector<float> result;
  result.reserve(pixel_values(width, height, channels));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const Block block{pixels, width * factor, channels, factor, x * factor, y * factor};
      for (int c = 0; c < channels; ++c) result.push_back(reduce(block, c, reduction));
    }
  }
  return result;
}

ByteImage display_bytes(std::vector<std::uint8_t> rgb, int width, int height, int factor) {
  assert(rgb.size() == pixel_values(width * factor, height * factor, 3));
  if (factor == 1) return {3, std::move(rgb)};
  std::vector<float> linear(rgb.size());
  std::transform(rgb.begin(), rgb.end(), linear.begin(), [](std::uint8_t v) { return linear_of_byte()[v]; });
  return each(3, reduced(linear, width, height, 3, factor, Reduction::mean), glsl::srgb_encode);
}

std::array<std::uint8_t, 3> label_color(float label) {
  // After Okabe and Ito 2008, "Color universal design", further apart in brightness.
  static constexpr std::array<std::array<std::uint8_t, 3>, label_color_count> colors{{{{0, 90, 160}},
                                                                                      {{230, 159, 0}},
                                                                                      {{0, 158, 115}},
                                                                                      {{204, 121, 167}},
                                                                                      {{120, 200, 245}},
                                                                                      {{245, 235, 80}},
                                                                                      {{170, 60, 0}},
                                                                                      {{90, 90, 90}}}};
  constexpr float most = 65536;
  if (!(label >= 0 && label < most)) return {};
  return colors[static_cast<std::size_t>(label) % colors.size()];
}

ByteImage aov_bytes(std::string_view name, int channels, const std::vector<float>& pixels) {
  if (name == "cascade" || name == "history") return label_bytes(channels, pixels);
  if (name == "depth") return depth_bytes(pixels);
  if (name == "albedo") return each(channels, pixels, glsl::srgb_encode);
  if (name == "motion") return with_third(relative_bytes(channels, pixels, /* is_signed= */ true));
  if (name.ends_with("normal")) return each(channels, pixels, [](float v) { return 0.5f + 0.5f * v; });
  if (name == "shadow" || name == "material") return each(channels, pixels, [](float v) { return v; });
  return relative_bytes(channels, pixels, /* is_signed= */ name == "position");
}

}  // namespace penumbra::render

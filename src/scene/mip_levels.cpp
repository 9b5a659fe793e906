#include "scene/mip_levels.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "scene/srgb.h"

namespace penumbra::scene {

namespace {

constexpr std::size_t channels = 4;

// From a code to its value, 0 to 1.
using Decoding = std::array<float, 256>;
// From a value, in steps, to its code. The steps are a twentieth of the least difference between two codes of sRGB.
using Encoding = std::array<std::uint8_t, 65536>;

struct Coding {
  Decoding decode;
  Encoding encode;
};

Coding make_coding(bool srgb) {
  Coding coding{};
  const auto value_of = [&](float code) { return srgb ? srgb_decode(code / 255.0f) : code / 255.0f; };
  for (std::size_t code = 0; code < coding.decode.size(); ++code)
    coding.decode[code] = value_of(static_cast<float>(code));
  constexpr auto last = static_cast<float>(Encoding{}.size() - 1);
  std::size_t step = 0;
  for (int code = 0; code < 256; ++code) {
    const float limit = code == 255 ? 2.0f : value_of(static_cast<float>(code) + 0.5f);
    for (; step < coding.encode.size() && static_cast<float>(step) / last < limit; ++step)
      coding.encode[step] = static_cast<std::uint8_t>(code);
  }
  return coding;
}

const Coding& coding_of(bool srgb) {
  static const Coding colors = make_coding(true), plain = make_coding(false);
  return srgb ? colors : plain;
}

std::uint8_t encoded(const Coding& coding, float value) {
  constexpr auto last = static_cast<float>(Encoding{}.size() - 1);
  constexpr float half = 0.5f;
  return coding.encode[static_cast<std::size_t>(value * last + half)];
}

// The texels of one axis that a texel of the next level covers, and the share of each.
struct Cover {
  int first = 0, count = 1;
  std::array<float, 3> shares{1, 0, 0};
};

// 2n + 1 texels become n: the i-th covers the last (n - i) / n of texel 2i, the next, and (i + 1) / n of the third.
std::vector<Cover> covers_of(int from, int to) {
  std::vector<Cover> covers(static_cast<std::size_t>(to));
  if (from == 1) return covers;
  for (int i = 0; i < to; ++i) {
    Cover& cover = covers[static_cast<std::size_t>(i)];
    const auto area = static_cast<float>(from);
    cover = {.first = 2 * i, .count = 2, .shares = {0.5f, 0.5f, 0}};
    if (from % 2 != 0)
      cover = {.first = 2 * i,
               .count = 3,
               .shares = {static_cast<float>(to - i) / area, static_cast<float>(to) / area,
                          static_cast<float>(i + 1) / area}};
  }
  return covers;
}

struct Level {
  int width = 1, height = 1;
  std::span<const std::uint8_t> rgba;
};

MipLevel next_level(const Level& from, const Coding& colors, const Coding& alpha) {
  MipLevel to{.width = std::max(from.width / 2, 1), .height = std::max(from.height / 2, 1), .rgba = {}};
  const std::vector<Cover> columns = covers_of(from.width, to.width), rows = covers_of(from.height, to.height);
  to.rgba.reserve(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height) * channels);
  for (const Cover& row : rows) {
    for (const Cover& column : columns) {
      std::array<float, channels> sum{};
      for (int y = 0; y < row.count; ++y) {
        const auto line = static_cast<std::size_t>(row.first + y) * static_cast<std::size_t>(from.width);
        const std::uint8_t* texel = &from.rgba[(line + static_cast<std::size_t>(column.first)) * channels];
        for (int x = 0; x < column.count; ++x, texel += channels) {
          const float share = row.shares[static_cast<std::size_t>(y)] * column.shares[static_cast<std::size_t>(x)];
          for (std::size_t c = 0; c < 3; ++c) sum[c] += share * colors.decode[texel[c]];
          sum[3] += share * alpha.decode[texel[3]];
        }
      }
      for (std::size_t c = 0; c < 3; ++c) to.rgba.push_back(encoded(colors, sum[c]));
      to.rgba.push_back(encoded(alpha, sum[3]));
    }
  }
  return to;
}

}  // namespace

std::vector<MipLevel> mip_levels(const Image& image, bool srgb) {
  std::vector<MipLevel> levels;
  Level last{.width = image.width, .height = image.height, .rgba = image.rgba};
  while (last.width > 1 || last.height > 1) {
    const MipLevel& next = levels.emplace_back(next_level(last, coding_of(srgb), coding_of(false)));
    last = {.width = next.width, .height = next.height, .rgba = next.rgba};
  }
  return levels;
}

}  // namespace penumbra::scene

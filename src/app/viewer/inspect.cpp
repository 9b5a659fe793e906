#include "app/viewer/inspect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "app/heat_map.h"
#include "app/label_color.h"
#include "core/names.h"
#include "gl/texture_format.h"
#include "lib/packed_texel.glsl"
#include "lib/tone_map.glsl"
#include "metrics/heat_color.h"

namespace penumbra::app {

namespace {

constexpr std::string_view target_prefix = "target ";

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(std::isnan(value) ? 0.0f : value, 0.0f, 1.0f) * 255.0f));
}

using Rgb = std::array<std::uint8_t, 3>;

float channel(const Values& values, const float* pixel, int index) {
  return pixel[std::min(index, values.channels - 1)];
}

Rgb color_of(const Values& values, const float* pixel, const Look& look, const Range& range) {
  const float span = std::max(range.high - range.low, std::numeric_limits<float>::min());
  const auto part = [&](float v) { return (v - range.low) / span; };
  switch (look.scale) {
    case ColorScale::labels:
      return label_color(pixel[0]);
    case ColorScale::grey:
      return {to_byte(part(pixel[0])), to_byte(part(pixel[0])), to_byte(part(pixel[0]))};
    case ColorScale::heat:
      return metrics::heat_color(part(pixel[0]));
    case ColorScale::rgb: {
      const auto encoded = [&](int c) {
        return to_byte(glsl::srgb_encode(std::clamp(part(channel(values, pixel, c)), 0.0f, 1.0f)));
      };
      return {encoded(0), encoded(1), encoded(2)};
    }
    case ColorScale::vectors: {
      const auto about_grey = [&](int c) {
        return c < values.channels ? to_byte(0.5f + 0.5f * pixel[c] / range.high) : std::uint8_t{128};
      };
      return {about_grey(0), about_grey(1), about_grey(2)};
    }
  }
  return {};
}

Values flipped(Values values) {
  const auto row = static_cast<std::size_t>(values.width) * static_cast<std::size_t>(values.channels);
  for (std::size_t y = 0; y < static_cast<std::size_t>(values.height) / 2; ++y) {
    const auto low = values.numbers.begin() + static_cast<std::ptrdiff_t>(y * row);
    const auto high = values.numbers.end() - static_cast<std::ptrdiff_t>((y + 1) * row);
    std::swap_ranges(low, low + static_cast<std::ptrdiff_t>(row), high);
  }
  return values;
}

// Those that can be seen: alpha is none of them.
int channels_of(const gl::Texture& texture) {
  int count = 0;
  for (const GLenum part : {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE}) {
    GLint bits = 0;
    gl::glGetTextureLevelParameteriv(texture.id(), 0, part, &bits);
    count += bits > 0 ? 1 : 0;
  }
  return std::max(count, 1);
}

Values read_target(const Inspection& inspection, const gl::Device& device) {
  const std::string name = inspection.what.substr(target_prefix.size());
  std::vector<std::string> names;
  for (const gl::Device::NamedTarget& target : device.targets()) {
    names.emplace_back(target.name);
    if (target.name != name) continue;
    const gl::TextureDesc& desc = target.texture->desc();
    const int level = std::clamp(inspection.level, 0, desc.levels - 1);
    const int layer = std::clamp(inspection.layer, 0, desc.layers - 1);
    Values values{.width = std::max(desc.width >> level, 1),
                  .height = std::max(desc.height >> level, 1),
                  .channels = channels_of(*target.texture),
                  .numbers = {}};
    if (gl::format_info(desc.format).kind == gl::ChannelKind::unsigned_integer) {
      const std::vector<unsigned> bits = gl::read_uints(*target.texture, values.channels, level, layer);
      // 32 bits are a packed texel of a mask on its way through history and filters: its visibility is what is looked
      // at.
      const bool packed = desc.format == GL_R32UI;
      std::transform(bits.begin(), bits.end(), std::back_inserter(values.numbers), [packed](unsigned texel) {
        return packed ? glsl::texel_visibility(texel) : static_cast<float>(texel);
      });
    } else {
      values.numbers = gl::read_floats(*target.texture, values.channels, level, layer);
    }
    return flipped(std::move(values));
  }
  fail_unknown("target", name, names);
}

Values read_aov(const std::string& name, const render::Renderer& renderer, const gl::Device& device) {
  const std::vector<render::Aov>& all = render::aovs();
  const auto aov = std::find_if(all.begin(), all.end(), [&](const render::Aov& each) { return each.name == name; });
  Values values{.numbers = renderer.read_aov(name)};
  values.channels = static_cast<int>(aov->channels.size());
  for (const gl::Device::NamedTarget& target : device.targets()) {
    if (target.name != "display") continue;
    values.width = target.texture->width();
    values.height = target.texture->height();
  }
  return values;
}

}  // namespace

const float* Values::at(int x, int y) const {
  const auto index = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  return &numbers[index * static_cast<std::size_t>(channels)];
}

Look look_of(std::string_view what) {
  using enum ColorScale;
  static const std::vector<std::string> refusals{"kept", "none there", "off screen", "another surface", "caster moved"};
  if (what == "shadow") return {.scale = grey, .fixed = true};
  if (what == "under_texel") return {.scale = labels, .labels = {"wider than a texel", "narrower"}};
  if (what == "cascade") return {.scale = labels, .labels = {"0 (finest)", "1", "2", "3", "4", "5", "6", "7"}};
  if (what == "history") return {.scale = labels, .labels = refusals};
  if (what == "color" || what == "albedo" || what == "material") return {.scale = rgb, .fixed = true};
  if (what == "emission") return {.scale = rgb};
  if (what == "normal" || what == "geometric_normal") return {.scale = vectors, .fixed = true};
  if (what == "motion") return {.scale = vectors, .unit = "px"};
  if (what == "depth" || what == "blocker" || what == "penumbra") return {.scale = heat, .unit = "m"};
  return {.scale = heat};
}

Values read_values(const Inspection& inspection, const render::Renderer& renderer, const gl::Device& device) {
  if (inspection.what.starts_with(target_prefix)) return read_target(inspection, device);
  return read_aov(inspection.what, renderer, device);
}

Range range_of(const Inspection& inspection, const Look& look, const Values& values) {
  if (!inspection.automatic) return {inspection.low, inspection.high};
  if (look.fixed) return {look.low, look.high};
  float low = 0, high = 0;
  for (const float v : values.numbers) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  const auto round_number = [](float largest) { return std::max(heat_scale(largest), largest); };
  if (look.scale == ColorScale::vectors) return {0, round_number(std::max(high, -low))};
  return {low < 0 ? -round_number(-low) : 0.0f, round_number(high)};
}

std::vector<std::uint8_t> colors_of(const Values& values, const Look& look, const Range& range) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(static_cast<std::size_t>(values.width) * static_cast<std::size_t>(values.height) * 4);
  for (int y = values.height; y-- > 0;) {
    for (int x = 0; x < values.width; ++x) {
      const Rgb rgb = color_of(values, values.at(x, y), look, range);
      rgba.insert(rgba.end(), {rgb[0], rgb[1], rgb[2], 255});
    }
  }
  return rgba;
}

glm::vec3 color_at(ColorScale scale, float value) {
  Rgb rgb{to_byte(value), to_byte(value), to_byte(value)};
  if (scale == ColorScale::heat) rgb = metrics::heat_color(value);
  if (scale == ColorScale::labels) rgb = label_color(value);
  return glm::vec3(rgb[0], rgb[1], rgb[2]) / 255.0f;
}

Values difference(const Values& a, const Values& b) {
  Values result = a;
  std::transform(a.numbers.begin(), a.numbers.end(), b.numbers.begin(), result.numbers.begin(),
                 [](float x, float y) { return std::abs(x - y); });
  return result;
}

}  // namespace penumbra::app

#include "viewer/inspect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lib/tone_map.glsl"
#include "metrics/heat_color.h"
#include "metrics/heat_map.h"
#include "render/aov_picture.h"
#include "viewer/targets.h"

namespace penumbra::viewer {

namespace {

std::uint8_t to_byte(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(std::isnan(value) ? 0.0f : value, 0.0f, 1.0f) * 255.0f));
}

using Rgb = std::array<std::uint8_t, 3>;

float channel(const Values& values, const float* pixel, int index) {
  return pixel[std::min(index, values.channels - 1)];
}

Rgb color_of(const Values& values, const float* pixel, const ColorMapping& mapping, const Range& range) {
  const float span = std::max(range.high - range.low, std::numeric_limits<float>::min());
  const auto part = [&](float v) { return (v - range.low) / span; };
  switch (mapping.scale) {
    case ColorScale::labels:
      return render::label_color(pixel[0]);
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

void toggle_cascade_tint(Inspection& inspection) {
  const bool on = inspection.what == "cascade" && inspection.over;
  inspection = on ? Inspection{} : Inspection{.what = "cascade", .over = true};
}

const float* Values::at(int x, int y) const {
  const auto index = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  return &numbers[index * static_cast<std::size_t>(channels)];
}

ColorMapping mapping_of(std::string_view aov) {
  using enum ColorScale;
  static const std::vector<std::string> refusals{"kept", "none there", "off screen", "another surface", "caster moved"};
  if (aov == "shadow") return {.scale = grey, .fixed = true};
  if (aov == "under_texel") return {.scale = labels, .labels = {"wider than a texel", "narrower"}};
  if (aov == "cascade") return {.scale = labels, .labels = {"0 (finest)", "1", "2", "3", "4", "5", "6", "7"}};
  if (aov == "history") return {.scale = labels, .labels = refusals};
  if (aov == "color" || aov == "albedo" || aov == "material") return {.scale = rgb, .fixed = true};
  if (aov == "emission") return {.scale = rgb};
  if (aov == "normal" || aov == "geometric_normal") return {.scale = vectors, .fixed = true};
  if (aov == "texel") return {.scale = heat, .unit = "px"};
  if (aov == "motion") return {.scale = vectors, .unit = "px"};
  if (aov == "position") return {.scale = vectors, .unit = "m"};
  if (aov == "depth" || aov == "blocker" || aov == "penumbra") return {.scale = heat, .unit = "m"};
  return {.scale = heat};
}

ColorMapping mapping_of(const Inspection& inspection, const gl::Device& device) {
  const std::optional<gl::Device::NamedTarget> target = inspected_target(inspection, device);
  if (!target) return mapping_of(inspection.what);
  const std::vector<TargetPart> parts = parts_of(*target);
  return parts[part_index(parts, inspection)].mapping;
}

Values read_values(const Inspection& inspection, const render::Renderer& renderer, const gl::Device& device) {
  if (is_target(inspection.what)) return read_target(inspection, device);
  return read_aov(inspection.what, renderer, device);
}

Range range_of(const Inspection& inspection, const ColorMapping& mapping, const Values& values) {
  if (!inspection.automatic) return {inspection.low, inspection.high};
  if (mapping.fixed) return {mapping.low, mapping.high};
  float low = 0, high = 0;
  for (const float v : values.numbers) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  const auto round_number = [](float largest) { return std::max(metrics::heat_scale(largest), largest); };
  if (mapping.scale == ColorScale::vectors) return {0, round_number(std::max(high, -low))};
  return {low < 0 ? -round_number(-low) : 0.0f, round_number(high)};
}

std::vector<std::uint8_t> colors_of(const Values& values, const ColorMapping& mapping, const Range& range) {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(static_cast<std::size_t>(values.width) * static_cast<std::size_t>(values.height) * 4);
  for (int y = values.height; y-- > 0;) {
    for (int x = 0; x < values.width; ++x) {
      const Rgb rgb = color_of(values, values.at(x, y), mapping, range);
      rgba.insert(rgba.end(), {rgb[0], rgb[1], rgb[2], 255});
    }
  }
  return rgba;
}

glm::vec3 color_at(ColorScale scale, float value) {
  Rgb rgb{to_byte(value), to_byte(value), to_byte(value)};
  if (scale == ColorScale::heat) rgb = metrics::heat_color(value);
  if (scale == ColorScale::labels) rgb = render::label_color(value);
  return glm::vec3(rgb[0], rgb[1], rgb[2]) / 255.0f;
}

Values difference(const Values& a, const Values& b) {
  Values result{.width = a.width, .height = a.height, .channels = 1, .numbers = {}};
  const auto channels = static_cast<std::size_t>(a.channels);
  for (std::size_t i = 0; i < a.numbers.size(); i += channels) {
    float largest = 0;
    for (std::size_t c = i; c < i + channels; ++c) largest = std::max(largest, std::abs(a.numbers[c] - b.numbers[c]));
    result.numbers.push_back(largest);
  }
  return result;
}

}  // namespace penumbra::viewer

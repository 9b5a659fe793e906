#include "viewer/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <utility>

#include "core/names.h"
#include "gl/texture_format.h"
#include "lib/packed_texel.glsl"
#include "render/setup.h"
#include "shadow/denoise_context.h"
#include "viewer/picture_renderer.h"

namespace penumbra::viewer {

namespace {

constexpr std::string_view target_prefix = "target ";

// Fields of integer texels, in their order in a texel's parts.
struct Field {
  const char* name;
  ColorMapping mapping;
  float (*of)(unsigned texel);
};

// A shadow mask between history and filters.
const std::array<Field, 3>& texel_fields() {
  static const std::array<Field, 3> fields{
      Field{"visibility", {.scale = ColorScale::grey, .fixed = true}, glsl::texel_visibility},
      Field{"mean blocker distance", {.unit = "m"}, glsl::texel_distance},
      Field{"history invalid", {.scale = ColorScale::labels, .labels = {"kept", "invalid"}}, [](unsigned texel) {
              return glsl::texel_invalid(texel) ? 1.0f : 0.0f;
            }}};
  return fields;
}

const std::array<Field, 4>& notes_fields() {
  static const std::array<Field, 4> fields{
      Field{"layer of the map", mapping_of("cascade"),
            [](unsigned notes) { return static_cast<float>(glsl::notes_layer(notes)); }},
      Field{"under a texel", mapping_of("under_texel"),
            [](unsigned notes) { return glsl::notes_under_texel(notes) ? 1.0f : 0.0f; }},
      Field{"narrow",
            {.scale = ColorScale::labels, .labels = {"stands for pixels around it", "narrow"}},
            [](unsigned notes) { return glsl::notes_narrow(notes) ? 1.0f : 0.0f; }},
      Field{"history", mapping_of("history"),
            [](unsigned notes) { return static_cast<float>(glsl::notes_refusal(notes)); }}};
  return fields;
}

// Whether a target of packed_format holds packed texels: those of a denoiser's mask, its history, or a filter.
bool holds_packed_texels(std::string_view name) {
  return name.ends_with("/texels") || name.find("/history texels/") != name.npos || name.find("/filter ") != name.npos;
}

// Of those that hold several values in one channel; else empty. A packed texel's second channel, a depth, is not shown.
std::span<const Field> fields_of(const gl::Device::NamedTarget& target) {
  const GLenum format = target.texture->desc().format;
  if (format == shadow::packed_format && holds_packed_texels(target.name)) return texel_fields();
  return format == GL_R8UI ? std::span<const Field>(notes_fields()) : std::span<const Field>();
}

// Without alpha, which is not shown.
int channels_of(const gl::Texture& texture) {
  int count = 0;
  for (const GLenum part : {GL_TEXTURE_RED_SIZE, GL_TEXTURE_GREEN_SIZE, GL_TEXTURE_BLUE_SIZE}) {
    GLint bits = 0;
    gl::glGetTextureLevelParameteriv(texture.id(), 0, part, &bits);
    count += bits > 0 ? 1 : 0;
  }
  return std::max(count, 1);
}

// Whether all values lie from 0 to 1.
bool is_share(std::string_view name) {
  return name.find("/noise/") != name.npos || name.ends_with("movement map") || name.ends_with("/mask");
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

// Drops all channels but one.
void keep_channel(Values& values, int channel) {
  std::vector<float> kept;
  kept.reserve(values.numbers.size() / static_cast<std::size_t>(values.channels));
  for (auto i = static_cast<std::size_t>(channel); i < values.numbers.size();
       i += static_cast<std::size_t>(values.channels))
    kept.push_back(values.numbers[i]);
  values.numbers = std::move(kept);
  values.channels = 1;
}

}  // namespace

bool is_target(std::string_view what) { return what.starts_with(target_prefix); }

std::string target_of_view(std::string_view what, int view) {
  std::string name(what);
  constexpr std::string_view first = "/view 0/";
  const std::size_t at = is_target(what) ? name.find(first) : name.npos;
  if (at != name.npos) name.replace(at, first.size(), fmt::format("/view {}/", view));
  return name;
}

bool is_of_other_view(std::string_view name) {
  return name.find("/view ") != name.npos && name.find("/view 0/") == name.npos;
}

std::vector<TargetPart> parts_of(const gl::Device::NamedTarget& target) {
  std::vector<TargetPart> parts;
  if (const std::span<const Field> fields = fields_of(target); !fields.empty()) {
    for (const Field& field : fields) parts.push_back({field.name, field.mapping});
    return parts;
  }
  constexpr std::array names{"red", "green", "blue"};
  const ColorMapping mapping =
      is_share(target.name) ? ColorMapping{.scale = ColorScale::grey, .fixed = true} : ColorMapping{};
  const int channels = channels_of(*target.texture);
  for (std::size_t i = 0; i < static_cast<std::size_t>(channels); ++i) parts.push_back({names.at(i), mapping});
  if (channels == 3) parts.push_back({"all as a colour", {.scale = ColorScale::rgb}});
  return parts;
}

std::size_t part_index(const std::vector<TargetPart>& parts, const Inspection& inspection) {
  return std::min(static_cast<std::size_t>(std::max(inspection.part, 0)), parts.size() - 1);
}

std::string target_label(std::string_view name, const LoadedScene* scene) {
  std::string label(name);
  for (const std::string_view once : {"shadow 1/", "view 0/"}) {
    if (label.starts_with(once)) label.erase(0, once.size());
  }
  if (scene == nullptr) return label;
  const std::vector<std::string> lights = render::shadowed_names(scene->prepared.setup);
  const std::vector<int> ids = render::light_ids(scene->prepared.setup);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const std::string prefix = fmt::format("light {}/", ids[i]);
    if (!label.starts_with(prefix)) continue;
    label.erase(0, prefix.size());
    if (lights.size() == 1) return label;
    // Several nodes may share a light of the file.
    const bool is_unique = std::ranges::count(lights, lights[i]) == 1;
    return is_unique ? fmt::format("{}/{}", lights[i], label) : fmt::format("{} ({})/{}", lights[i], ids[i], label);
  }
  return label;
}

std::string about_target(std::string_view name) {
  struct About {
    std::string_view in_name;
    const char* text;
  };
  static constexpr std::array list{
      About{"/history_and_filters/texels", "The shadow mask with its history, before the first filter: packed texels."},
      About{
          "/history_and_filters/notes",
          "Beside the packed mask: the shadow map's layer, whether the kernel is under a texel, whether the shadow is "
          "narrow (with mask.scale), and why the history was refused."},
      About{"/history_and_filters/history texels",
            "The packed mask that the next frame blends with; two textures take turns."},
      About{"/history_and_filters/history surfaces",
            "Depth and normal, from which the next frame computes whether a pixel shows the same surface."},
      About{"/history_and_filters/", "The shadow mask after this filter's step: packed texels."},
      About{"/movement map",
            "How much of the area around a texel has moving casters: 0 none, 1 all. Of the last frame with motion."},
      About{"/first maps/", "Of the small maps that show where penumbrae may be (cascades.fit=penumbrae)."},
      About{"/shadow map", "Depth from the light, 0 to 1, a layer for each cascade."},
      About{"/recipes/least_depth_pyramid/",
            "The least depth from the light that a texel of each mip level covers, in green beside edges of the map."},
      About{"/tile decisions",
            "A texel for each tile of 8 × 8 pixels: which of them are lit, where no penumbra is near."},
      About{"/noise/", "The tile of noise that rotates or shifts the sample points of each pixel."},
      About{"/scale ", "With mask.scale: every n-th pixel. In its mask, narrow shadows are -1 - visibility."},
      About{"/mask", "What lighting reads: visibility in red."}};
  const auto found =
      std::find_if(list.begin(), list.end(), [&](const About& about) { return name.find(about.in_name) != name.npos; });
  return found == list.end() || !name.starts_with("shadow ") ? "" : found->text;
}

std::optional<gl::Device::NamedTarget> inspected_target(const Inspection& inspection, const gl::Device& device) {
  for (const gl::Device::NamedTarget& target : device.targets()) {
    if (inspection.what == std::string(target_prefix) + std::string(target.name)) return target;
  }
  return {};
}

std::string title_of(const Inspection& inspection, const gl::Device& device, const LoadedScene* scene) {
  const std::optional<gl::Device::NamedTarget> target = inspected_target(inspection, device);
  if (!target && !is_target(inspection.what)) return inspection.what;
  if (!target) return target_label(std::string_view(inspection.what).substr(target_prefix.size()), scene);
  const std::vector<TargetPart> parts = parts_of(*target);
  const std::string label = target_label(target->name, scene);
  return parts.size() == 1 ? label : label + ": " + parts[part_index(parts, inspection)].name;
}

Values read_target(const Inspection& inspection, const gl::Device& device) {
  const std::optional<gl::Device::NamedTarget> target = inspected_target(inspection, device);
  if (!target) {
    std::vector<std::string> names;
    for (const gl::Device::NamedTarget& each : device.targets()) names.emplace_back(each.name);
    fail_unknown("target", inspection.what.substr(target_prefix.size()), names);
  }
  const gl::TextureDesc& desc = target->texture->desc();
  const int level = std::clamp(inspection.level, 0, desc.levels - 1);
  const int layer = std::clamp(inspection.layer, 0, desc.layers - 1);
  const auto part = static_cast<int>(part_index(parts_of(*target), inspection));
  Values values{.width = std::max(desc.width >> level, 1),
                .height = std::max(desc.height >> level, 1),
                .channels = channels_of(*target->texture),
                .numbers = {}};
  if (const std::span<const Field> fields = fields_of(*target); !fields.empty()) {
    values.channels = 1;
    const std::vector<unsigned> texels = gl::read_uints(*target->texture, 1, level, layer);
    std::transform(texels.begin(), texels.end(), std::back_inserter(values.numbers),
                   fields[static_cast<std::size_t>(part)].of);
  } else if (gl::format_info(desc.format).kind == gl::ChannelKind::unsigned_integer) {
    const std::vector<unsigned> numbers = gl::read_uints(*target->texture, values.channels, level, layer);
    values.numbers.assign(numbers.begin(), numbers.end());
  } else {
    values.numbers = gl::read_floats(*target->texture, values.channels, level, layer);
  }
  if (part < values.channels && values.channels > 1) keep_channel(values, part);
  return flipped(std::move(values));
}

}  // namespace penumbra::viewer

#include "light_projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <limits>

#include "receiver_region.h"
#include "shared/shadow_block.h"

namespace penumbra::shadow {

namespace {

static_assert(SHADOW_MAX_LAYERS == max_layers && max_cascades <= max_layers);

// What float's precision leaves of positions in the world, in the map's and in the receivers' matrices, metres.
float position_rounding(const glm::dvec3& place) { return 2.4e-7f * static_cast<float>(glm::length(place)); }

// `shift`: where the origin of the cascades' light space lies in the view's, whose origin is the camera, at `eye`.
glsl::LayerBlock layer_block(const Cascade& cascade, int size, const glm::dvec3& shift, const glm::dvec3& eye) {
  const float range = cascade.far_z - cascade.near_z;
  const glm::vec2 texel = 2.0f * cascade.half_extent / static_cast<float>(size);
  const float larger = glm::max(texel.x, texel.y);
  // A few units in the last place of the map's stored and the rasteriser's interpolated depths.
  const float rounding = 4e-7f * (range + 2.0f * glm::max(cascade.half_extent.x, cascade.half_extent.y));
  return {.center = cascade.center + glm::vec2(shift),
          .widths_per_metre = 0.5f / cascade.half_extent,
          .texel_shares = texel / larger,
          .texel = larger,
          .near_depth = cascade.near_z + static_cast<float>(shift.z),
          .depth_range = range,
          .rounding = rounding,
          .texel_uv = 1.0f / static_cast<float>(size),
          .position_rounding = position_rounding(eye)};
}

// Least depth along the rays, relative to the camera, of a box.
float least_depth(const glm::dmat3& world_to_light, const Box& box, const glm::dvec3& eye) {
  const glm::dvec3 along = glm::transpose(world_to_light)[2];
  const glm::dvec3 low = glm::dvec3(box.min) - eye;
  const glm::dvec3 high = glm::dvec3(box.max) - eye;
  return static_cast<float>(glm::dot(glm::min(along * low, along * high), glm::dvec3(1)));
}

// The face of a lamp, in units in which the lamp is a sun: tangents across, and −1 / depth along its axis. Shaders
// scale them to metres at the depth of a receiver.
glsl::LayerBlock layer_block(const LampMaps& lamp) {
  const auto range = static_cast<float>(1 / lamp.near - 1 / lamp.far);
  return {.center = glm::vec2(0),
          .widths_per_metre = glm::vec2(static_cast<float>(0.5 / lamp.tangent)),
          .texel_shares = glm::vec2(1),
          .texel = static_cast<float>(2 * lamp.tangent / lamp.size),
          .near_depth = static_cast<float>(-1 / lamp.near),
          .depth_range = range,
          .rounding = 4e-7f * range,
          .texel_uv = 1.0f / static_cast<float>(lamp.size),
          .position_rounding = position_rounding(lamp.position)};
}

void write_to(glsl::ShadowBlock& block, const Cascades& cascades, const glm::dmat4& view_to_world,
              const std::optional<Box>& moved) {
  const glm::dvec3 eye(view_to_world[3]);
  const glm::dmat3& world_to_light = cascades.world_to_light;
  const glm::dvec3 shift = world_to_light * (cascades.anchor - eye);
  block.view_to_light = glm::mat4(glm::dmat4(world_to_light * glm::dmat3(view_to_world)));
  block.world_to_light = glm::mat4(glm::dmat4(world_to_light));
  block.axes_turn = {std::cos(cascades.turn), std::sin(cascades.turn)};
  block.light_stretch = 1;
  // If it is unknown what moved, assume the near plane of the last layer, which contains every caster.
  const double nearest = cascades.items.empty() ? 0.0 : cascades.items.back().near_z + shift.z;
  block.moved_depth = moved ? least_depth(world_to_light, *moved, eye) : static_cast<float>(nearest);
  for (size_t i = 0; i < cascades.items.size(); ++i) {
    block.widest = block.layers[i] = layer_block(cascades.items[i], cascades.size, shift, eye);
  }
}

void write_to(glsl::ShadowBlock& block, const LampMaps& lamp, const glm::dmat4& view_to_world,
              const std::optional<Box>& moved) {
  block.view_to_light = glm::mat4(glm::dmat4(lamp.world_to_lamp * glm::dmat3(view_to_world)));
  block.world_to_light = glm::mat4(glm::dmat4(lamp.world_to_lamp));
  block.axes_turn = {1, 0};
  block.light_is_lamp = 1;
  block.light_stretch = static_cast<float>(lamp.greatest_stretch());
  block.lamp =
      glm::vec4(glm::vec3(glm::inverse(view_to_world) * glm::dvec4(lamp.position, 1)), static_cast<float>(lamp.cone));
  block.lamp_range = lamp.range > 0 ? static_cast<float>(lamp.range) : std::numeric_limits<float>::max();
  block.moved_depth = static_cast<float>(moved ? least_depth(lamp, *moved) : lamp.near);
  for (int i = 0; i < lamp.count; ++i) block.widest = block.layers[i] = layer_block(lamp);
}

LampMaps fit(const Lamp& lamp, const FitInputs& inputs) {
  return fit_lamp({.position = lamp.position,
                   .axis = lamp.axis,
                   .cone = lamp.cone,
                   .radius = lamp.radius,
                   .range = lamp.range,
                   .nearest = inputs.params.get_float("lamps.near"),
                   .size = inputs.params.get_int("lamps.size"),
                   .casters = inputs.casters,
                   .receivers = inputs.receivers});
}

CascadeInputs cascade_inputs(const Sun& sun, const FitInputs& inputs) {
  const ParamSet& params = inputs.params;
  return {.view = inputs.view,
          .projection = inputs.projection,
          .nearest = inputs.nearest,
          .to_light = sun.to_light,
          .tan_half_angle = shape_of(sun, params).extent,
          .casters = inputs.casters,
          .receivers = inputs.receivers,
          .exact_bounds = inputs.exact_bounds,
          .count = params.get_int("cascades.count"),
          .size = params.get_int("cascades.size"),
          .divides_texels = inputs.divides_texels,
          .split_blend = params.get_float("cascades.split"),
          .distance = params.get_float("cascades.distance"),
          .visible = inputs.visible,
          .near_penumbrae = inputs.near_penumbrae,
          .may_turn = !shape_of(sun, params).square,
          .jitter = inputs.jitter,
          .others = inputs.others};
}

template <class Value>
bool all_finite(const Value* values, int count) {
  return std::all_of(values, values + count, [](Value value) { return std::isfinite(value); });
}

int layers_of(const Cascades& cascades) { return static_cast<int>(cascades.items.size()); }
int layers_of(const LampMaps& lamp) { return lamp.count; }

const glm::dmat4& clip_matrix(const Cascades& cascades, int layer) {
  return cascades.items.at(static_cast<size_t>(layer)).world_to_clip;
}
glm::dmat4 clip_matrix(const LampMaps& lamp, int layer) { return lamp.world_to_clip(layer); }

glm::dmat4 caster_matrix(const Cascades& cascades, int layer) { return clip_matrix(cascades, layer); }
glm::dmat4 caster_matrix(const LampMaps& lamp, int layer) {
  glm::dmat4 matrix = lamp.world_to_clip(layer);
  if (!lamp.drawn_reversed) return matrix;
  for (glm::length_t i = 0; i < 4; ++i) matrix[i].z = matrix[i].w - matrix[i].z;
  return matrix;
}

// The middle of a cascade, and a lamp's centre.
glm::dvec3 anchor_of(const Cascades&, const glm::dmat4& world_to_clip) {
  return glm::dvec3(glm::inverse(world_to_clip) * glm::dvec4(0, 0, 0.5, 1));
}
glm::dvec3 anchor_of(const LampMaps& lamp, const glm::dmat4&) { return lamp.position; }

CullVolume volume_of(const Cascades& cascades, int layer) { return cull_volume(cascades, layer); }
CullVolume volume_of(const LampMaps& lamp, int layer) { return lamp.cull_volume(layer); }

std::string cascade_fault(const Cascade& cascade, size_t index) {
  const bool finite = all_finite(glm::value_ptr(cascade.center), 2) &&
                      all_finite(glm::value_ptr(cascade.half_extent), 2) && std::isfinite(cascade.near_z) &&
                      std::isfinite(cascade.far_z) && all_finite(glm::value_ptr(cascade.world_to_clip), 16);
  if (!finite) return fmt::format("cascade {} is not finite", index);
  if (!(cascade.half_extent.x > 0) || !(cascade.half_extent.y > 0) || !(cascade.far_z > cascade.near_z))
    return fmt::format("cascade {} has no extent", index);
  return {};
}

std::string fault_in(const Cascades& cascades) {
  const int layers = layers_of(cascades);
  if (layers < 1 || layers > max_cascades) return fmt::format("{} cascades, 1 to {} fit", layers, max_cascades);
  if (!all_finite(glm::value_ptr(cascades.world_to_light), 9) || !all_finite(glm::value_ptr(cascades.anchor), 3))
    return "the cascades' light space is not finite";
  for (size_t i = 0; i < cascades.items.size(); ++i) {
    if (std::string fault = cascade_fault(cascades.items[i], i); !fault.empty()) return fault;
  }
  return {};
}

std::string fault_in(const LampMaps& lamp) { return lamp.fault(); }

std::string fault_in(const Sun& sun) {
  const float length = glm::length(sun.to_light);
  return length > 0.5f && std::isfinite(length) ? std::string() : "has no direction";
}

std::string fault_in(const Lamp& lamp) {
  if (!all_finite(glm::value_ptr(lamp.position), 3)) return "has no position";
  if (glm::any(glm::greaterThan(glm::abs(lamp.position), glm::vec3(farthest_lamp))))
    return "is too far from the origin";
  if (!(lamp.radius >= 0 && lamp.radius <= farthest_lamp))
    return fmt::format("has a radius of {} m, not 0 to 1e6", lamp.radius);
  if (!(lamp.range >= 0)) return "has a range that is not 0 or more";
  const float length = glm::length(lamp.axis);
  if (!std::isfinite(length) || (length > 0 && std::abs(length - 1) > 1e-2f))
    return "has an axis that is not of length 1";
  constexpr float widest = 1.5708f;
  if (length > 0 && !(lamp.cone > 0 && lamp.cone <= widest)) return "has a cone that is not between 0 and π/2";
  return {};
}

}  // namespace

int LightProjection::layers() const {
  return std::visit([](const auto& maps) { return layers_of(maps); }, maps_);
}

int LightProjection::given_layers() const {
  const auto* sun = std::get_if<Cascades>(&maps_);
  return layers() - (sun != nullptr && sun->composed ? 1 : 0);
}

int LightProjection::size() const {
  return std::visit([](const auto& maps) { return maps.size; }, maps_);
}

glm::vec2 LightProjection::texel(int layer) const {
  if (const auto* lamp = std::get_if<LampMaps>(&maps_))
    return glm::vec2(static_cast<float>(2 * lamp->tangent * lamp->far / lamp->size));
  return cascades().texel(layer);
}

bool LightProjection::texels_vary() const { return std::holds_alternative<LampMaps>(maps_); }

float LightProjection::depth_range(int layer) const {
  if (const auto* lamp = std::get_if<LampMaps>(&maps_))
    return static_cast<float>(lamp->far * lamp->far * (1 / lamp->near - 1 / lamp->far));
  const Cascade& cascade = cascades().items.at(static_cast<size_t>(layer));
  return static_cast<float>(cascade.far_z - cascade.near_z);
}

glm::mat4 LightProjection::world_to_clip(int layer) const {
  return std::visit([&](const auto& maps) { return glm::mat4(clip_matrix(maps, layer)); }, maps_);
}

glm::mat4 LightProjection::casters_to_clip(int layer) const {
  return std::visit([&](const auto& maps) { return glm::mat4(caster_matrix(maps, layer)); }, maps_);
}

AnchoredMatrix LightProjection::anchored_to_clip(int layer) const {
  return std::visit(
      [&](const auto& maps) {
        const glm::vec3 anchor(anchor_of(maps, clip_matrix(maps, layer)));
        return AnchoredMatrix{glm::mat4(glm::translate(caster_matrix(maps, layer), glm::dvec3(anchor))), anchor};
      },
      maps_);
}

bool LightProjection::drawn_reversed() const {
  const auto* lamp = std::get_if<LampMaps>(&maps_);
  return lamp != nullptr && lamp->drawn_reversed;
}

CullVolume LightProjection::cull_volume(int layer) const {
  return std::visit([&](const auto& maps) { return volume_of(maps, layer); }, maps_);
}

CullVolume LightProjection::cull_volume_of_all() const {
  if (const auto* lamp = std::get_if<LampMaps>(&maps_)) return lamp->cull_volume_of_all();
  return cull_volume(layers() - 1);
}

std::optional<TexelRange> LightProjection::texels_of(int layer, const Box& world_box) const {
  if (!cull_volume(layer).holds(world_box)) return std::nullopt;
  const glm::dmat4 world_to_clip =
      std::visit([&](const auto& maps) { return glm::dmat4(clip_matrix(maps, layer)); }, maps_);
  const auto last = static_cast<double>(size() - 1);
  glm::dvec2 low(1e30);
  glm::dvec2 high(-1e30);
  for (const glm::dvec3& corner : world_box.corners()) {
    const glm::dvec4 clip = world_to_clip * glm::dvec4(corner, 1);
    // Of a lamp: beside it or behind it, where a box may cover anything.
    if (!(clip.w > 1e-9)) return TexelRange{glm::ivec2(0), glm::ivec2(size() - 1)};
    const glm::dvec2 texel = (glm::dvec2(clip) / clip.w * 0.5 + 0.5) * static_cast<double>(size());
    low = glm::min(low, texel);
    high = glm::max(high, texel);
  }
  return TexelRange{glm::ivec2(glm::clamp(glm::floor(low) - 1.0, 0.0, last)),
                    glm::ivec2(glm::clamp(glm::floor(high) + 1.0, 0.0, last))};
}

TexelRange LightProjection::drawn_texels(int layer) const {
  if (const auto* cascades = std::get_if<Cascades>(&maps_)) return cascades->drawn_texels(layer);
  return {glm::ivec2(0), glm::ivec2(size() - 1)};
}

void LightProjection::set_drawn_texels(int layer, const TexelRange& texels) {
  if (auto* cascades = std::get_if<Cascades>(&maps_)) cascades->items.at(static_cast<size_t>(layer)).drawn = texels;
}

CutOff LightProjection::cut_off() const {
  const auto* cascades = std::get_if<Cascades>(&maps_);
  return cascades != nullptr ? cascades->cut_off : CutOff{};
}

void LightProjection::write(glsl::ShadowBlock& block, const glm::dmat4& view_to_world,
                            const std::optional<Box>& moved) const {
  block.layer_count = layers();
  block.map_size = static_cast<float>(size());
  std::visit([&](const auto& maps) { write_to(block, maps, view_to_world, moved); }, maps_);
}

std::string LightProjection::fault() const {
  return std::visit([](const auto& maps) { return fault_in(maps); }, maps_);
}

int lamp_map_count(const LightSource& source) {
  const auto* lamp = std::get_if<Lamp>(&source);
  if (lamp == nullptr) return 0;
  return has_one_map(lamp->axis, lamp->cone) ? 1 : cube_faces;
}

glm::vec4 place_of(const LightSource& source) {
  if (const auto* lamp = std::get_if<Lamp>(&source)) return {lamp->position, 1};
  return {glm::normalize(std::get<Sun>(source).to_light), 0};
}

glm::dmat3 light_axes(const LightSource& source) { return light_axes(glm::dvec3(std::get<Sun>(source).to_light)); }

LightProjection fit_projection(const LightSource& source, const FitInputs& inputs) {
  if (const auto* lamp = std::get_if<Lamp>(&source)) return fit(*lamp, inputs);
  return fit_cascades(cascade_inputs(std::get<Sun>(source), inputs));
}

LightProjection narrowed(const LightProjection& projection, const LightSource& source, const FitInputs& inputs,
                         const ReadBounds& read) {
  const auto* sun = std::get_if<Sun>(&source);
  if (sun == nullptr) return projection;
  Cascades cascades = projection.cascades();
  ReadMargins margins{.texels = read_margin + inputs.params.get_float("bias.normal_offset"),
                      .ndc = glm::max(std::abs(read.jitter.x), std::abs(read.jitter.y))};
  if (read.moved) margins.nearest = least_depth(cascades.world_to_light, *read.moved, cascades.anchor);
  narrow_to_receivers(cascades, cascade_inputs(*sun, inputs), margins);
  return cascades;
}

bool fits_to_view(const LightSource& source) { return std::holds_alternative<Sun>(source); }
bool fits_to_view(const ParamSet& params) { return params.get_word("cascades.fit") != "stable"; }

LightShape shape_of(const LightSource& source, const ParamSet& params) {
  if (const auto* lamp = std::get_if<Lamp>(&source)) return {.extent = lamp->radius, .square = false, .lamp = true};
  return {.extent = std::tan(glm::radians(params.get_float("sun.angle")) * 0.5f),
          .square = params.get_word("sun.shape") == "square"};
}

std::string fault_of(const LightSource& source) {
  return std::visit([](const auto& light) { return fault_in(light); }, source);
}

}  // namespace penumbra::shadow

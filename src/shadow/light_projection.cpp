#include "light_projection.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "receiver_region.h"
#include "shared/shadow_block.h"

namespace penumbra::shadow {

namespace {

static_assert(SHADOW_MAX_LAYERS == max_layers && max_cascades <= max_layers);

// `shift`: where the origin of the cascades' light space lies in the view's, whose origin is the camera.
glsl::LayerBlock layer_block(const Cascade& cascade, int size, const glm::dvec3& shift) {
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
          .unused = 0};
}

// Least depth along the rays, relative to the camera, of a box.
float least_depth(const glm::dmat3& world_to_light, const Box& box, const glm::dvec3& eye) {
  const glm::dvec3 along = glm::transpose(world_to_light)[2];
  const glm::dvec3 low = glm::dvec3(box.min) - eye;
  const glm::dvec3 high = glm::dvec3(box.max) - eye;
  return static_cast<float>(glm::dot(glm::min(along * low, along * high), glm::dvec3(1)));
}

CascadeInputs cascade_inputs(const LightSource& source, const FitInputs& inputs) {
  const Sun& sun = std::get<Sun>(source);
  const ParamSet& params = inputs.params;
  return {.view = inputs.view,
          .projection = inputs.projection,
          .to_light = sun.to_light,
          .tan_half_angle = shape_of(source, params).extent,
          .casters = inputs.casters,
          .receivers = inputs.receivers,
          .count = params.get_int("cascades.count"),
          .size = params.get_int("cascades.size"),
          .split_blend = params.get_float("cascades.split"),
          .distance = params.get_float("cascades.distance"),
          .visible = inputs.visible,
          .may_turn = !shape_of(source, params).square,
          .others = inputs.others};
}

template <class Value>
bool all_finite(const Value* values, int count) {
  return std::all_of(values, values + count, [](Value value) { return std::isfinite(value); });
}

std::string cascade_fault(const Cascade& cascade, size_t index) {
  const bool finite = all_finite(glm::value_ptr(cascade.center), 2) &&
                      all_finite(glm::value_ptr(cascade.half_extent), 2) && std::isfinite(cascade.near_z) &&
                      std::isfinite(cascade.far_z) && all_finite(glm::value_ptr(cascade.world_to_clip), 16);
  if (!finite) return fmt::format("cascade {} is not finite", index);
  if (!(cascade.half_extent.x > 0) || !(cascade.half_extent.y > 0) || !(cascade.far_z > cascade.near_z))
    return fmt::format("cascade {} has no extent", index);
  return {};
}

}  // namespace

glm::mat4 LightProjection::world_to_clip(int layer) const {
  return glm::mat4(cascades_.items.at(static_cast<size_t>(layer)).world_to_clip);
}

float LightProjection::depth_range(int layer) const {
  const Cascade& cascade = cascades_.items.at(static_cast<size_t>(layer));
  return static_cast<float>(cascade.far_z - cascade.near_z);
}

CullVolume LightProjection::cull_volume(int layer) const { return shadow::cull_volume(cascades_, layer); }

std::optional<TexelRange> LightProjection::texels_of(int layer, const Box& world_box) const {
  if (!cull_volume(layer).holds(world_box)) return std::nullopt;
  const glm::dmat4& world_to_clip = cascades_.items.at(static_cast<size_t>(layer)).world_to_clip;
  glm::dvec2 low(1e30);
  glm::dvec2 high(-1e30);
  for (const glm::dvec3& corner : world_box.corners()) {
    const glm::dvec2 clip(world_to_clip * glm::dvec4(corner, 1));
    const glm::dvec2 texel = (clip * 0.5 + 0.5) * static_cast<double>(size());
    low = glm::min(low, texel);
    high = glm::max(high, texel);
  }
  const auto last = static_cast<double>(size() - 1);
  return TexelRange{glm::ivec2(glm::clamp(glm::floor(low) - 1.0, 0.0, last)),
                    glm::ivec2(glm::clamp(glm::floor(high) + 1.0, 0.0, last))};
}

void LightProjection::set_drawn_texels(int layer, const TexelRange& texels) {
  cascades_.items.at(static_cast<size_t>(layer)).drawn = texels;
}

void LightProjection::write(glsl::ShadowBlock& block, const glm::dmat4& view_to_world,
                            const std::optional<Box>& moved) const {
  const glm::dvec3 eye(view_to_world[3]);
  const glm::dmat3& world_to_light = cascades_.world_to_light;
  const glm::dvec3 shift = world_to_light * (cascades_.anchor - eye);
  block.view_to_light = glm::mat4(glm::dmat4(world_to_light * glm::dmat3(view_to_world)));
  block.world_to_light = glm::mat4(glm::dmat4(world_to_light));
  block.axes_turn = {std::cos(cascades_.turn), std::sin(cascades_.turn)};
  block.layer_count = layers();
  block.map_size = static_cast<float>(size());
  // If it is unknown what moved, assume the near plane of the last layer, which contains every caster.
  const double nearest = cascades_.items.empty() ? 0.0 : cascades_.items.back().near_z + shift.z;
  block.moved_depth = moved ? least_depth(world_to_light, *moved, eye) : static_cast<float>(nearest);
  for (size_t i = 0; i < cascades_.items.size(); ++i) {
    block.widest = block.layers[i] = layer_block(cascades_.items[i], cascades_.size, shift);
  }
}

std::string LightProjection::fault() const {
  if (layers() < 1 || layers() > max_cascades) return fmt::format("{} cascades, 1 to {} fit", layers(), max_cascades);
  if (!all_finite(glm::value_ptr(cascades_.world_to_light), 9) || !all_finite(glm::value_ptr(cascades_.anchor), 3))
    return "the cascades' light space is not finite";
  for (size_t i = 0; i < cascades_.items.size(); ++i) {
    if (std::string fault = cascade_fault(cascades_.items[i], i); !fault.empty()) return fault;
  }
  return {};
}

glm::dmat3 light_axes(const LightSource& source) { return light_axes(glm::dvec3(std::get<Sun>(source).to_light)); }

LightProjection fit_projection(const LightSource& source, const FitInputs& inputs) {
  return fit_cascades(cascade_inputs(source, inputs));
}

LightProjection narrowed(const LightProjection& projection, const LightSource& source, const FitInputs& inputs,
                         const ReadBounds& read) {
  Cascades cascades = projection.cascades();
  ReadMargins margins{.texels = read_margin + inputs.params.get_float("bias.normal_offset"),
                      .ndc = glm::max(std::abs(read.jitter.x), std::abs(read.jitter.y))};
  if (read.moved) margins.nearest = least_depth(cascades.world_to_light, *read.moved, cascades.anchor);
  narrow_to_receivers(cascades, cascade_inputs(source, inputs), margins);
  return cascades;
}

LightShape shape_of(const LightSource& /*source*/, const ParamSet& params) {
  return {.extent = std::tan(glm::radians(params.get_float("sun.angle")) * 0.5f),
          .square = params.get_word("sun.shape") == "square"};
}

std::string fault_of(const LightSource& source) {
  const float length = glm::length(std::get<Sun>(source).to_light);
  return length > 0.5f && std::isfinite(length) ? std::string() : "has no direction";
}

}  // namespace penumbra::shadow

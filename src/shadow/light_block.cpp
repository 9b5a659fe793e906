#include "light_block.h"

#include <algorithm>
#include <span>

namespace penumbra::shadow {

namespace {

// Offsets by the rules of std140; a test compares them with the driver's.
static_assert(sizeof(glsl::LayerBlock) == 48);
static_assert(offsetof(glsl::ShadowBlock, viewport) == 320);
static_assert(offsetof(glsl::ShadowBlock, depth_to_ndc) == 416);
static_assert(offsetof(glsl::ShadowBlock, light_extent) == 448);
static_assert(offsetof(glsl::ShadowBlock, lamp) == 512);
static_assert(offsetof(glsl::ShadowBlock, layers) == 576);

// ShadowBlock::pixel_size: metres that a pixel spans where clip w is 1, then factor and offset that give clip w from
// view-space z.
glm::vec4 pixel_size(const glm::mat4& projection, const Rect& viewport) {
  return {2.0f / (projection[0][0] * static_cast<float>(viewport.width)),
          2.0f / (projection[1][1] * static_cast<float>(viewport.height)), projection[2][3], projection[3][3]};
}

// The bias of a layer covers what 32-bit floats and depths of 24 bits round away; depths of fewer bits are farther off.
void add_rounding(glsl::ShadowBlock& block, const DepthRounding& of_maps) {
  constexpr float covered = 0x1p-23f;
  if (of_maps.absolute <= covered) return;
  const auto add = [&](glsl::LayerBlock& layer) { layer.rounding += of_maps.absolute * layer.depth_range; };
  add(block.widest);
  std::ranges::for_each(std::span(block.layers).first(static_cast<std::size_t>(block.layer_count)), add);
}

}  // namespace

glsl::ShadowBlock shadow_block(const Inputs& inputs, const LightFrame& light, const LightTraits& traits) {
  const Conventions& conventions = inputs.conventions;
  const glm::dmat4 view_to_world = glm::inverse(glm::dmat4(inputs.view.view));
  const bool zero_to_one = conventions.depth_zero_to_one;
  const glm::dmat4 view_to_last_clip =
      glm::dmat4(inputs.view.last_projection) * glm::dmat4(inputs.view.last_view) * view_to_world;
  glsl::ShadowBlock block{};
  light.projection.write(block, view_to_world, inputs.moved);
  add_rounding(block, traits.map_rounding);
  block.clip_to_view = glm::mat4(glm::inverse(glm::dmat4(inputs.view.projection)));
  block.view_to_last_clip = glm::mat4(view_to_last_clip);
  block.last_clip_to_view = glm::mat4(glm::inverse(view_to_last_clip));
  block.viewport = {light.viewport.x, light.viewport.y, light.viewport.width, light.viewport.height};
  block.jitter = {inputs.view.jitter, traits.last_jitter};
  block.pixel_size = pixel_size(inputs.view.projection, light.viewport);
  block.noise_shift = traits.noise.shift;
  std::ranges::copy(traits.noise.place, block.noise_place);
  block.depth_to_ndc = zero_to_one ? glm::vec2(1, 0) : glm::vec2(2, -1);
  block.normals_from_depth = traits.made_normals ? 1 : 0;
  block.normal_decode = {conventions.normals_scale, conventions.normals_offset};
  if (traits.made_normals) block.normal_decode = {1, 0};
  block.depth_error = {traits.depth_error.absolute, traits.depth_error.relative};
  block.vertex_rounding = traits.vertex_rounding;
  block.maps_are_moved = traits.moved_maps ? 1 : 0;
  block.sky_depth = conventions.reversed_z ? 0.0f : 1.0f;
  block.octahedral_normals = traits.made_normals || conventions.octahedral_normals ? 1 : 0;
  block.light_extent = light.shape.extent;
  block.light_is_square = light.shape.square ? 1 : 0;
  block.history_valid = light.history ? 1 : 0;
  block.has_motion = inputs.motion.id != 0 ? 1 : 0;
  block.casters_moved = light.casters_moved ? 1 : 0;
  return block;
}

}  // namespace penumbra::shadow

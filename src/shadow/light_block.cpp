#include "light_block.h"

namespace penumbra::shadow {

namespace {

// As std140 lays them out; a test asks the driver too.
static_assert(sizeof(glsl::LayerBlock) == 32);
static_assert(offsetof(glsl::ShadowBlock, viewport) == 320);
static_assert(offsetof(glsl::ShadowBlock, depth_to_ndc) == 384);
static_assert(offsetof(glsl::ShadowBlock, light_extent) == 400);
static_assert(offsetof(glsl::ShadowBlock, layers) == 432);
static_assert(SHADOW_MAX_LAYERS == max_cascades);

// `shift`: where the origin of the cascade's light space lies in the view's.
glsl::LayerBlock layer_block(const Cascade& cascade, int size, const glm::dvec3& shift) {
  const float range = cascade.far_z - cascade.near_z;
  const float texel = 2.0f * cascade.half_extent / static_cast<float>(size);
  // A few units in the last place of what a map stores and a rasteriser interpolates.
  const float rounding = 4e-7f * (range + 2.0f * cascade.half_extent);
  return {.center = cascade.center + glm::vec2(shift),
          .widths_per_metre = 0.5f / cascade.half_extent,
          .texel = texel,
          .near_depth = cascade.near_z + static_cast<float>(shift.z),
          .depth_range = range,
          .rounding = rounding,
          .pad = 0.0f};
}

// Of a pixel in the plane of the image, for each unit of clip-space w; and how w follows from view-space z.
glm::vec4 pixel_size(const glm::mat4& projection, const Rect& viewport) {
  return {2.0f / (projection[0][0] * static_cast<float>(viewport.width)),
          2.0f / (projection[1][1] * static_cast<float>(viewport.height)), projection[2][3], projection[3][3]};
}

// Least depth along the light, from the camera, of what moved since the last frame.
float least_moved_depth(const Inputs& inputs, const LightFrame& light, const glm::dvec3& eye, double last_near) {
  if (!inputs.moved) return static_cast<float>(last_near);
  const glm::dvec3 along = glm::transpose(light.cascades.world_to_light)[2];
  const glm::dvec3 low = glm::dvec3(inputs.moved->min) - eye;
  const glm::dvec3 high = glm::dvec3(inputs.moved->max) - eye;
  return static_cast<float>(glm::dot(glm::min(along * low, along * high), glm::dvec3(1)));
}

}  // namespace

glsl::ShadowBlock shadow_block(const Inputs& inputs, const LightFrame& light, const LightTraits& traits) {
  const Conventions& conventions = inputs.conventions;
  const glm::dmat4 view_to_world = glm::inverse(glm::dmat4(inputs.view.view));
  const bool zero_to_one = conventions.depth_zero_to_one;
  const glm::dvec3 eye(view_to_world[3]);
  const glm::dvec3 shift = light.cascades.world_to_light * (light.cascades.anchor - eye);
  const glm::dmat4 view_to_last_clip =
      glm::dmat4(inputs.view.last_projection) * glm::dmat4(inputs.view.last_view) * view_to_world;
  glsl::ShadowBlock block{};
  block.clip_to_view = glm::mat4(glm::inverse(glm::dmat4(inputs.view.projection)));
  block.view_to_light = glm::mat4(glm::dmat4(light.cascades.world_to_light * glm::dmat3(view_to_world)));
  block.world_to_light = glm::mat4(glm::dmat4(light.cascades.world_to_light));
  block.view_to_last_clip = glm::mat4(view_to_last_clip);
  block.last_clip_to_view = glm::mat4(glm::inverse(view_to_last_clip));
  block.viewport = {light.viewport.x, light.viewport.y, light.viewport.width, light.viewport.height};
  block.jitter = {inputs.view.jitter, traits.last_jitter};
  block.pixel_size = pixel_size(inputs.view.projection, light.viewport);
  block.noise_shift = traits.noise_shift;
  block.depth_to_ndc = zero_to_one ? glm::vec2(1, 0) : glm::vec2(2, -1);
  block.sky_depth = conventions.reversed_z ? 0.0f : 1.0f;
  block.octahedral_normals = conventions.octahedral_normals ? 1 : 0;
  block.light_extent = light.tan_half_angle;
  block.light_is_square = traits.square ? 1 : 0;
  block.layer_count = static_cast<int>(light.cascades.items.size());
  block.map_size = static_cast<float>(light.cascades.size);
  const double nearest = light.cascades.items.empty() ? 0.0 : light.cascades.items.back().near_z + shift.z;
  block.history_valid = light.history ? 1 : 0;
  block.has_motion = inputs.motion.id != 0 ? 1 : 0;
  block.casters_moved = light.casters_moved ? 1 : 0;
  block.moved_depth = least_moved_depth(inputs, light, eye, nearest);
  for (size_t i = 0; i < light.cascades.items.size(); ++i) {
    block.layers[i] = layer_block(light.cascades.items[i], light.cascades.size, shift);
  }
  return block;
}

}  // namespace penumbra::shadow

#include "light_block.h"

namespace penumbra::shadow {

namespace {

static_assert(sizeof(glsl::CascadeBlock) == 32);
static_assert(offsetof(glsl::ShadowBlock, viewport) == 192);
static_assert(offsetof(glsl::ShadowBlock, cascades) == 272);

// `shift`: where the origin of the cascade's light space lies in the view's.
glsl::CascadeBlock cascade_block(const Cascade& cascade, int size, const glm::dvec3& shift) {
  const float range = cascade.far_z - cascade.near_z;
  const float texel = 2.0f * cascade.half_extent / static_cast<float>(size);
  // A few units in the last place of what a map stores and a rasteriser interpolates.
  const float rounding = 4e-7f * (range + 2.0f * cascade.half_extent);
  return {{cascade.center + glm::vec2(shift), 0.5f / cascade.half_extent, texel},
          {cascade.near_z + static_cast<float>(shift.z), range, rounding, 0.0f}};
}

}  // namespace

glsl::ShadowBlock shadow_block(const Inputs& inputs, const LightFrame& light, const LightTraits& traits) {
  const Conventions& conventions = inputs.conventions;
  const glm::dmat4 view_to_world = glm::inverse(glm::dmat4(inputs.view.view));
  const bool zero_to_one = conventions.depth_zero_to_one;
  const glm::dvec3 shift = light.cascades.world_to_light * (light.cascades.anchor - glm::dvec3(view_to_world[3]));
  glsl::ShadowBlock block{};
  block.clip_to_view = glm::mat4(glm::inverse(glm::dmat4(inputs.view.projection)));
  block.view_to_light = glm::mat4(glm::dmat4(light.cascades.world_to_light * glm::dmat3(view_to_world)));
  block.world_to_light = glm::mat4(glm::dmat4(light.cascades.world_to_light));
  block.viewport = {light.viewport.x, light.viewport.y, light.viewport.width, light.viewport.height};
  block.jitter = {inputs.view.jitter, 0, 0};
  block.depth_to_ndc = {zero_to_one ? 1.0f : 2.0f, zero_to_one ? 0.0f : -1.0f, conventions.reversed_z ? 0.0f : 1.0f,
                        conventions.octahedral_normals ? 1.0f : 0.0f};
  block.light = {light.tan_half_angle, traits.square ? 1.0f : 0.0f, static_cast<float>(light.cascades.items.size()),
                 static_cast<float>(light.cascades.size)};
  block.noise_shift = traits.noise_shift;
  for (size_t i = 0; i < light.cascades.items.size(); ++i) {
    block.cascades[i] = cascade_block(light.cascades.items[i], light.cascades.size, shift);
  }
  return block;
}

}  // namespace penumbra::shadow

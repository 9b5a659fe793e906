#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "render/passes.h"

namespace penumbra::render {

namespace {

shadow::TextureView view_of(const gl::Texture& texture) { return {texture.id(), texture.width(), texture.height()}; }

shadow::Box box_of(const scene::Bounds& bounds) { return {bounds.min, bounds.max}; }

shadow::Box box_or_none(const scene::Bounds& bounds) {
  return bounds.empty ? shadow::Box{glm::vec3(1), glm::vec3(-1)} : box_of(bounds);
}

std::optional<shadow::Box> moved_box(const scene::GpuScene& scene, Moved moved) {
  if (moved == Moved::unknown) return {};
  return box_or_none(moved == Moved::nothing ? scene::Bounds{} : scene.moved_bounds());
}

shadow::LightSource source_of(const SunLight& sun) { return shadow::Sun{.to_light = sun.to_light}; }

shadow::LightSource source_of(const LampLight& lamp) {
  return shadow::Lamp{.position = lamp.position,
                      .radius = lamp.radius,
                      .axis = lamp.axis,
                      .cone = lamp.outer_cone,
                      .range = lamp.range};
}

scene::Overlap overlap_of(const shadow::CullVolume& volume, const shadow::Box& box) {
  if (!volume.holds(box)) return scene::Overlap::none;
  return volume.contains(box) ? scene::Overlap::all : scene::Overlap::part;
}

scene::CasterSubset casters_of(shadow::CasterKind kind) {
  switch (kind) {
    case shadow::CasterKind::moved_now:
      return scene::CasterSubset::moved_now;
    case shadow::CasterKind::moved_last:
      return scene::CasterSubset::moved_last;
    case shadow::CasterKind::depth_and_moved:
      return scene::CasterSubset::all_and_moved;
    case shadow::CasterKind::depth:
    case shadow::CasterKind::second_depth:
    case shadow::CasterKind::geometry:
      break;
  }
  return scene::CasterSubset::all;
}

scene::CasterMatrix matrix_of(const shadow::CasterPass& casters) {
  return {.to_clip = casters.anchored.to_clip, .anchor = casters.anchored.anchor};
}

}  // namespace

std::vector<shadow::Light> shadow_lights(std::span<const FrameLight> lights, std::span<const int> ids) {
  std::vector<shadow::Light> all;
  for (const FrameLight& light : lights.first(std::min<std::size_t>(lights.size(), max_shadowed_lights))) {
    all.push_back({.id = ids.empty() ? static_cast<int>(all.size()) : ids[all.size()],
                   .source = std::visit([](const auto& kind) { return source_of(kind); }, light)});
  }
  return all;
}

bool is_hidden(const FrameLight& light, bool on_ground, const ParamSet& params) {
  const SunLight* sun = std::get_if<SunLight>(&light);
  return on_ground && sun != nullptr && sun->to_light.y < -std::sin(glm::radians(params.get_float("sun.angle")) * 0.5f);
}

bool has_lamps(std::span<const FrameLight> lights) {
  return std::ranges::any_of(lights, [](const FrameLight& light) { return std::holds_alternative<LampLight>(light); });
}

shadow::Mask draw_shadow_mask(gl::Device& device, const ShadowMaskInputs& inputs) {
  const gl::Texture& depth = *inputs.gbuffer.depth;
  const float aspect = static_cast<float>(depth.width()) / static_cast<float>(depth.height());
  std::vector<bool> hidden;
  for (const FrameLight& light : inputs.frame_lights.first(inputs.lights.size()))
    hidden.push_back(is_hidden(light, inputs.on_ground, inputs.params));
  const FrameScene frame_scene{
      .scene = inputs.scene, .view = inputs.view, .depth = depth, .time = inputs.time, .hidden = hidden};
  const gl::Texture* drawn_motion = inputs.gbuffer.motion;
  const shadow::TextureView motion = drawn_motion != nullptr ? view_of(*drawn_motion) : shadow::TextureView{};
  const auto draw = [&](const shadow::CasterPass& casters, gl::Pass& pass) {
    if (casters.kind == shadow::CasterKind::geometry) {
      const auto reaches = [&](const scene::Bounds& box) { return casters.cull.holds(box_of(box)); };
      inputs.scene.draw_caster_geometry(device, pass, casters.program, casters.world_to_clip,
                                        shadow::place_of(casters.source), reaches);
    } else {
      const auto reaches = [&](const scene::Bounds& box) { return overlap_of(casters.cull, box_of(box)); };
      if (casters.kind == shadow::CasterKind::second_depth) {
        inputs.scene.draw_casters_behind(device, pass, casters.gap, matrix_of(casters), reaches);
      } else {
        inputs.scene.draw_casters(device, pass, casters_of(casters.kind), matrix_of(casters), reaches);
      }
    }
  };
  shadow::Mask mask = inputs.soft_shadows.render({.view = {.view = inputs.camera.view,
                                                           .projection = projection_of(inputs.camera, aspect),
                                                           .last_view = inputs.last_camera.view,
                                                           .last_projection = projection_of(inputs.last_camera, aspect),
                                                           .jitter = inputs.jitter,
                                                           .id = inputs.view_id,
                                                           .cut = inputs.cut,
                                                           .restart = inputs.restart},
                                                  .depth = view_of(depth),
                                                  .normals = view_of(*inputs.gbuffer.geometric_normal),
                                                  .motion = motion,
                                                  .lights = inputs.lights,
                                                  .casters = box_of(inputs.scene.casters()),
                                                  .receivers = box_of(inputs.scene.receivers()),
                                                  .exact_bounds = true,
                                                  .forward_receivers = box_or_none(inputs.scene.blended_receivers()),
                                                  .binds_forward = inputs.scene.has_blended(),
                                                  .moved = moved_box(inputs.scene, inputs.moved),
                                                  .mask_details = inputs.mask_details,
                                                  .draw = draw,
                                                  .user = &frame_scene},
                                                 inputs.params);
  // The scene's own surfaces would hide such a sun too, but for those that reach through the ground.
  for (std::size_t i = 0; i < mask.lights.size(); ++i) {
    if (!hidden[i]) continue;
    const gl::Pass pass(
        device, {.name = "hidden sun",
                 .colors = {{.texture = mask.texture, .layer = static_cast<int>(i), .clear = glm::vec4(0.0f)}}});
  }
  return mask;
}

}  // namespace penumbra::render

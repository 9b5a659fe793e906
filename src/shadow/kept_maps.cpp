#include "kept_maps.h"

#include "movement_map.h"

namespace penumbra::shadow {

MapContent content_of(const gl::Device& device, const gl::Texture& map, const LightProjection& projection,
                      const LightSource& source) {
  MapContent content{.texture = map.serial(),
                     .shader_changes = device.shaders.changes(),
                     .source = source,
                     .count = projection.layers(),
                     .layers = {}};
  for (int i = 0; i < content.count; ++i) {
    content.layers[static_cast<size_t>(i)] = {.world_to_clip = projection.world_to_clip(i),
                                              .anchored = projection.anchored_to_clip(i),
                                              .cull = projection.cull_volume(i),
                                              .drawn = projection.drawn_texels(i)};
  }
  return content;
}

LayerSet unchanged_layers(const MapContent& last, const MapContent& now, const std::optional<Box>& moved) {
  LayerSet unchanged;
  const bool same_map = last.texture != 0 && last.texture == now.texture && last.count == now.count &&
                        last.shader_changes == now.shader_changes && last.source == now.source;
  if (!same_map) return unchanged;
  for (size_t i = 0; i < static_cast<size_t>(now.count); ++i) {
    const MapContent::Layer& held = last.layers[i];
    unchanged[i] = held.world_to_clip == now.layers[i].world_to_clip && held.anchored == now.layers[i].anchored &&
                   held.drawn.contains(now.layers[i].drawn) && !may_hold_moved(held.cull, moved);
  }
  return unchanged;
}

}  // namespace penumbra::shadow

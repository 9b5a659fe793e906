#include "check_parts.h"

#include "../core/error.h"

namespace penumbra::shadow {

namespace {

// Whether each layer lies in the atlas.
void check_atlas(const FinishedMaps& maps, int light) {
  const int layers = maps.projection.given_layers(), size = maps.projection.size();
  if (maps.atlas.size() != static_cast<std::size_t>(layers)) {
    fail("soft shadows: light {} has an atlas of {} maps for {} layers", light, maps.atlas.size(), layers);
  }
  for (const glm::ivec2& corner : maps.atlas) {
    const bool inside =
        corner.x >= 0 && corner.y >= 0 && size <= maps.depth.width - corner.x && size <= maps.depth.height - corner.y;
    if (!inside) {
      fail("soft shadows: light {} has a map of {}×{} at {}, {}, which is not a part of its atlas of {}×{}", light,
           size, size, corner.x, corner.y, maps.depth.width, maps.depth.height);
    }
  }
}

void check_map_texture(const TextureView& depth, GLint count, int light) {
  const GLint layers = level_parameter(depth.id, GL_TEXTURE_DEPTH);
  if (layers < count) fail("soft shadows: light {} has {} maps for {} layers", light, layers, count);
}

}  // namespace

void check_maps(const Light& given, TextureChecks& checks) {
  if (!given.maps) return;
  const FinishedMaps& maps = *given.maps;
  const int light = given.id;
  const LightProjection& projection = maps.projection;
  if (const std::string fault = projection.fault(); !fault.empty()) fail("soft shadows: light {}: {}", light, fault);
  if (projection.texels_vary() != std::holds_alternative<Lamp>(given.source)) {
    fail("soft shadows: light {} is a {} and its maps are those of a {}", light,
         projection.texels_vary() ? "sun" : "lamp", projection.texels_vary() ? "lamp" : "sun");
  }
  const std::string name = fmt::format("maps of light {}", light);
  const TextureView& depth = maps.depth;
  check_given(name, depth);
  const TextureChecks::Key key{.id = depth.id,
                               .width = depth.width,
                               .height = depth.height,
                               .layers = projection.given_layers(),
                               .atlas = !maps.atlas.empty(),
                               .lamp = projection.texels_vary()};
  const TextureChecks::Source* found = checks.known_source(key);
  const bool known = found != nullptr, atlas = !maps.atlas.empty();
  TextureChecks::Source source = known ? *found : TextureChecks::Source();
  if (!known) {
    source.target = target_of_existing(name, depth);
    if (source.target != (atlas ? GL_TEXTURE_2D : GL_TEXTURE_2D_ARRAY)) {
      fail("soft shadows: {}: texture {} is not a {}", name, depth.id,
           atlas ? "GL_TEXTURE_2D, as an atlas is" : "GL_TEXTURE_2D_ARRAY");
    }
    check_size(name, depth);
    check_parameters(name, depth.id, 1);
    if (!holds_depth(depth.id)) fail("soft shadows: the maps of light {} hold no depth", light);
    const GLint bits = level_parameter(depth.id, GL_TEXTURE_DEPTH_SIZE);
    source.can_compare = bits > 0;
    source.rounding = depth_rounding_of(depth.id);
    if (bits == 0 && level_parameter(depth.id, GL_TEXTURE_RED_SIZE) < 32)
      fail("soft shadows: the maps of light {} hold half floats, which are too coarse", light);
    // Depths of a perspective need more than those of a sun, and the bias of lamps covers no coarser rounding.
    if (projection.texels_vary() && bits > 0 && bits < 24)
      fail("soft shadows: the map of light {} has depths of {} bits; a lamp's needs at least 24", light, bits);
  }
  if (atlas) {
    check_atlas(maps, light);
  } else if (depth.width != projection.size() || depth.height != projection.size()) {
    fail("soft shadows: light {} has maps of {}×{} and a projection for {}", light, depth.width, depth.height,
         projection.size());
  }
  if (!known && !atlas) check_map_texture(depth, projection.given_layers(), light);
  checks.add(key, source);
}

}  // namespace penumbra::shadow

#include "../../core/error.h"
#include "../pass_context.h"
#include "../recipe.h"
#include "../shadow_map.h"

namespace penumbra::shadow {

namespace {

// A colour texture, since a depth texture can't be tested against one depth while it keeps another.
gl::TextureDesc desc_of(const LightProjection& projection) {
  gl::TextureDesc desc = shadow_map_desc(projection);
  desc.format = GL_R32F;
  return desc;
}

// What of a layer no caster is drawn to stays as it was: nothing reads it.
const gl::Texture& build(const PassContext& context) {
  const LightProjection& projection = context.frame().projection;
  const gl::Texture& map = context.target("depth", desc_of(projection));
  const LayerSet unchanged = context.unchanged_layers();
  const float gap = context.params().get_float("maps.gap");
  for (int i = 0; i < projection.layers(); ++i) {
    if (unchanged[static_cast<size_t>(i)]) continue;
    if (!context.inputs().draw)
      fail("soft shadows: light {}: maps.layers=2 draws casters, and there is no caster callback", context.light().id);
    gl::PassDesc desc{.name = "second layer",
                      .colors = {{.texture = &map, .layer = i, .clear = glm::vec4(1)}},
                      .depth = gl::Attachment{.texture = &context.shadow_map(), .layer = i},
                      .depth_test = gl::DepthTest::greater,
                      .blend = gl::Blend::min};
    desc.depth_reversed = projection.drawn_reversed();
    desc.scissor = drawn_rect(projection, i);
    gl::Pass pass(context.device(), desc);
    context.draw_second_depth(pass, i, gap);
  }
  return map;
}

}  // namespace

Recipe second_layer() {
  using enum ParamBinding;
  return {.name = "second_layer",
          .summary = "Depth of the nearest surface behind the one in the shadow map: 1 where there is none.",
          .source = "Everitt 2001, Interactive order-independent transparency",
          .params = {{"maps.layers", 1, 1, 2, "",
                      "Surfaces along each ray of light that techniques can see: 2 keeps the shadows of what lies "
                      "below another caster, for techniques that read them (slices).",
                      compiled},
                     {"maps.gap", 0.0f, 0, 10, "m",
                      "Least distance of the second layer behind the first. What is thinner counts as one surface. "
                      "Under lamps it is that long at the far plane of their maps, and shrinks with the square of the "
                      "depth.",
                      host},
                     {"maps.overlap", 0.0f, 0, 1, "",
                      "0: a second layer that maps.layers asks for is always drawn. Above 0: only for pictures in "
                      "which casters may overlap in penumbrae as wide as this share of the picture's height, as the "
                      "small maps of cascades.fit=penumbrae show; with another fit, and for lamps, there is one layer. "
                      "Where blended surfaces read the maps, both are always drawn.",
                      host}},
          .depends_only_on_needs = true,
          .reads_light_discs = true,
          .tests_depths = true,
          .applies = [](const ParamSet& params) { return params.get_int("maps.layers") == 2; },
          .build = build};
}

}  // namespace penumbra::shadow

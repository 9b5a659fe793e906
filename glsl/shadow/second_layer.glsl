// The surfaces behind those that the map shows, for techniques that read them where maps.layers is 2.
#include "shadow/light.glsl"

#ifndef maps_layers
#define maps_layers 1  // of techniques that need no second layer
#endif

// Receivers below which no casters overlap need not read them.
#define READS_SECOND_LAYER (maps_layers == 2 && READS_ALL != 0)

#if READS_SECOND_LAYER
layout(binding = UNIT_second_layer) uniform sampler2DArray second_layer;

// Depth of the surface in a texel, metres; the far plane's where there is none.
float depth_behind(ivec2 texel, Light light) { return depth_in(second_layer, texel, light); }

// The same in the texels `first` to first + (1, 1), in the order of a Footprint.
vec4 depths_behind(ivec2 first, Light light) {
  return vec4(depth_behind(first + ivec2(0, 1), light), depth_behind(first + 1, light),
              depth_behind(first + ivec2(1, 0), light), depth_behind(first, light));
}
#endif

// Of two heights at one place, the share of the greater one below which the lower one is another caster's.
const float least_share_of_height = 0.6;

// Percentage-closer filtering with a tent as wide as so many texels, each of which counts with the part of the tent's
// volume that lies over it.
#include "shadow/light.glsl"

const float tent_radius = 0.5 * float(pcf_tent_width);  // texels
const int gathers_across = (pcf_tent_width + 2) / 2;    // for the width + 1 texels that a tent can touch

// Texels differ in size from layer to layer, so the radius does too: that of the finest layer which contains it.
float read_radius(Receiver receiver, Light light) {
  float radius = 0.0;
  for (int layer = 0; layer < light.layers; ++layer) {
    radius = tent_radius * texel_size(receiver, with_layer(light, layer));
    if (layer_edge(layer, receiver.position, radius, light) <= 1.0) break;
  }
  return radius;
}

// The parts of a tent of one dimension over two texels in succession, of which the first begins at that distance from
// the tent's middle.
vec2 parts(float begin) {
  vec3 at = clamp((begin + vec3(0.0, 1.0, 2.0)) / tent_radius, -1.0, 1.0);
  vec3 below = at * (1.0 - 0.5 * abs(at));
  return below.yz - below.xy;
}

// The share of the tent's volume that lies over texels that block.
float blocked_share(Receiver receiver, float bias, Light light) {
  vec2 middle = map_place(receiver.position, light);
  ivec2 first = ivec2(floor(middle - tent_radius));
  float blocked = 0.0;
  int i = 0;
  do {
    ivec2 texel = first + 2 * ivec2(i % gathers_across, i / gathers_across);
    vec2 begin = vec2(texel) - middle;
    Footprint texels = footprint_from(receiver, texel, vec2(0.0), -(begin + 0.5), light);
    vec4 blocks = blocking_texels(receiver, texels, bias);
    blocked += dot(blocks, parts(begin.x).xyyx * parts(begin.y).yyxx);
  } while (++i < gathers_across * gathers_across);
  return blocked;
}

Visibility visibility(Receiver receiver, Light light) {
  float bias = depth_bias(receiver, light);
  float blocked = blocked_share(receiver, bias, light);
  if (blocked == 0.0) return fully_lit();
  receiver = with_surroundings(receiver, bias, max_plane_slope, light);
  float lit = max(1.0 - blocked_share(receiver, bias, light), 0.0);
  return Visibility(lit, lit < 1.0 ? tent_radius * texel_size(receiver, light) : 0.0, 0.0, false, false);
}

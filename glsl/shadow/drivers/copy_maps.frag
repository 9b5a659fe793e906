// Copies one of the shadow maps of an atlas or an array. With COMPOSE: what it shows, into a map that holds more.
#if ATLAS
layout(binding = 8) uniform sampler2D maps;
uniform ivec2 corner;  // texel
#else
layout(binding = 8) uniform sampler2DArray maps;
uniform int layer;
#endif
uniform bool reversed;  // 1 is near the light

float depth_at(ivec2 texel) {
#if ATLAS
  float depth = texelFetch(maps, texel + corner, 0).x;
#else
  float depth = texelFetch(maps, ivec3(texel, layer), 0).x;
#endif
  return reversed ? 1.0 - depth : depth;
}

#if COMPOSE
uniform vec4 place;    // xy: scale and zw: offset from texels of the composed map to those of this one
uniform ivec2 last;    // texel of this map
uniform vec2 depths;   // x: scale and y: offset from depths of this map to those of the composed one
uniform float spread;  // most that depths of neighbouring texels of one surface differ

// The depth at a place between four texels: of the surface through them, or of the nearest texel where they show
// several or none.
void main() {
  vec2 at = clamp(gl_FragCoord.xy * place.xy + place.zw, vec2(0.0), vec2(last) + 1.0);
  vec2 between = at - 0.5, low = floor(between), share = between - low;
  ivec2 a = clamp(ivec2(low), ivec2(0), last), d = clamp(ivec2(low) + 1, ivec2(0), last);
  vec4 four = vec4(depth_at(a), depth_at(ivec2(d.x, a.y)), depth_at(ivec2(a.x, d.y)), depth_at(d));
  float least = min(min(four.x, four.y), min(four.z, four.w));
  float most = max(max(four.x, four.y), max(four.z, four.w));
  float depth = depth_at(min(ivec2(at), last));
  if (depth == 1.0) discard;
  if (most < 1.0 && most - least <= spread) {
    depth = mix(mix(four.x, four.y, share.x), mix(four.z, four.w, share.x), share.y);
  }
  gl_FragDepth = depth * depths.x + depths.y;
}
#else
void main() { gl_FragDepth = depth_at(ivec2(gl_FragCoord.xy)); }
#endif

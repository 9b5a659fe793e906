// Copies one of the shadow maps of an atlas or an array.
#if ATLAS
layout(binding = 8) uniform sampler2D maps;
uniform ivec2 corner;  // texel
#else
layout(binding = 8) uniform sampler2DArray maps;
uniform int layer;
#endif
uniform bool reversed;  // 1 is near the light

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy);
#if ATLAS
  float depth = texelFetch(maps, texel + corner, 0).x;
#else
  float depth = texelFetch(maps, ivec3(texel, layer), 0).x;
#endif
  gl_FragDepth = reversed ? 1.0 - depth : depth;
}

// Copies one of the shadow maps of an atlas.
layout(binding = 8) uniform sampler2D atlas;
uniform ivec2 corner;  // texel

void main() { gl_FragDepth = texelFetch(atlas, ivec2(gl_FragCoord.xy) + corner, 0).x; }

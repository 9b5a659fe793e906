// What a filter's last pass leaves of a texel. Included by the drivers.
layout(binding = 13) uniform usampler2D source_notes;

// See Mask; notes: bits 0 to 3 the cascade, 4 kernel smaller than a texel.
vec4 unpacked(uint texel, ivec2 pixel) {
  uint notes = texelFetch(source_notes, pixel, 0).x;
  float distance_to = texel_distance(texel);
  return vec4(texel_visibility(texel), shadow.light.x * distance_to, distance_to,
              float(notes & 0xfu) + ((notes & 0x10u) != 0u ? 0.5 : 0.0));
}

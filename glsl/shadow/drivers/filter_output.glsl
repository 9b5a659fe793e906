// The outputs of a filter's passes. Included by the drivers.

uvec2 filtered_with_depth(ivec2 pixel) { return uvec2(filtered(pixel), floatBitsToUint(stored_depth_at(pixel))); }

layout(binding = 13) uniform usampler2D source_notes;

// Of the last pass: see Mask.
vec4 unpacked(uint texel, ivec2 pixel) {
  uint notes = texelFetch(source_notes, pixel, 0).x;
  float distance_to = blended_distance(texel);
  // The sky has distance 0, whatever its position.
  float radius = distance_to > 0.0 ? packed_radius(light_position(view_position_at(pixel)), distance_to) : 0.0;
  return vec4(stored_visibility(texel_visibility(texel), notes_narrow(notes)), radius, distance_to,
              float(notes_layer(notes)) + (notes_under_texel(notes) ? 0.5 : 0.0));
}

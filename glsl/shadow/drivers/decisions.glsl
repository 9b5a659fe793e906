// What is decided at once for all pixels of a tile of 8 × 8.
const int tile_size = 8;

// A tile that needs no more than this.
struct Decision {
  uvec2 lit;               // bit 8 y + x, from .x to .y: the pixel is lit, else it is in shadow or faces away
  float blocker_distance;  // metres, a mean over the pixels in shadow; 0 if there are none
  float radius;            // metres, of the disc that holds what can block light of any of its receivers
  int layer;               // of the shadow map
};

uvec4 packed_decision(Decision decision) {
  float radius = 1.001 * decision.radius;  // must not get smaller by the rounding
  return uvec4(decision.lit, packHalf2x16(vec2(decision.blocker_distance, radius)), uint(decision.layer));
}

// Of a tile in a list of those to compute; `apart`: in the one of those that are listed apart.
uvec4 no_decision(bool apart) { return uvec4(uint(apart), 0u, 0u, ~0u); }

bool is_decided(uvec4 texel) { return texel.w != ~0u; }
bool is_listed_apart(uvec4 texel) { return !is_decided(texel) && texel.x != 0u; }

// Whether no pixel of a decided tile has a blocker distance.
bool is_unblocked(uvec4 texel) { return (texel.z & 0xffffu) == 0u; }

Decision unpacked_decision(uvec4 texel) {
  vec2 lengths = unpackHalf2x16(texel.z);
  return Decision(texel.xy, lengths.x, lengths.y, int(texel.w));
}

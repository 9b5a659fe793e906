// Lists the tiles whose texels a filter can change. The others have no pixel within `reach` of one with a blocker
// distance, and with noise if the filter has kernels: a filter of distances spreads them by one pixel, and visibility
// filters look two pixels far for one; or else their kernels are too narrow (see Filter::Keeps).
#include "shadow/drivers/gbuffer.glsl"
#include "shadow/drivers/kernel.glsl"
#include "lib/packed_texel.glsl"
#include "lib/rows.glsl"
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"

const int group = 8;             // tiles along each side that a work group lists
const int around = group + 2;    // those whose texels it reads
layout(local_size_x = group, local_size_y = group) in;
layout(binding = 12) uniform usampler2D texels;
layout(binding = 14) uniform usampler2D decisions;
uniform int has_decisions;
uniform int decided_have_noise;

struct Blocked {
  // Bits as in Decision::lit: pixels that have a blocker distance, for filters of visibility only those with noise, and
  // of decided tiles also those that face away or lie beyond the viewport.
  uvec2 pixels;
  uint farthest;  // the greatest distance, as in a packed texel
};

shared Blocked blocked[around * around];

ivec2 lowest_pixel_of(ivec2 tile) { return ivec2(shadow.viewport.xy) + tile * tile_size; }
ivec2 size_of(ivec2 tile) { return min(ivec2(shadow.viewport.zw) - tile * tile_size, tile_size); }

Blocked blocked_in(ivec2 tile) {
  if (has_decisions != 0) {
    uvec4 decision = texelFetch(decisions, tile, 0);
    if (is_decided(decision)) {
      if (KEEPS_NARROW != 0 && history_reuse == 0 && decided_have_noise == 0) return Blocked(uvec2(0u), 0u);
      return Blocked(is_unblocked(decision) ? uvec2(0u) : ~decision.xy, decision.z & 0xffffu);
    }
  }
  ivec2 size = size_of(tile);
  Blocked found = Blocked(uvec2(0u), 0u);
  ivec2 at = ivec2(0);
  do {
    uint texel = texelFetch(texels, lowest_pixel_of(tile) + at, 0).x;
    uint distance_to = KEEPS_NARROW != 0 && is_noise_free(texel) ? 0u : texel & distance_bits;
    int bit = tile_size * at.y + at.x;
    found.pixels[bit >> 5] |= uint(distance_to != 0u) << (bit & 31);
    found.farthest = max(found.farthest, distance_to);
    at = next_in_rows(at, 0, size.x - 1, 1);
  } while (at.y < size.y);
  return found;
}

// The pixels of a tile on that side, -1, 0 or 1 along each axis, that are within reach of the tile in the middle.
uvec2 pixels_in_reach(ivec2 side) {
  const uint reach = 3u;
  const uint low = (1u << reach) - 1u, high = low << (uint(tile_size) - reach);
  uint row = 0x01010101u * (side.x == 0 ? 0xffu : side.x < 0 ? high : low);
  const uint low_rows = (1u << (reach * uint(tile_size))) - 1u, high_rows = ~0u << (32u - reach * uint(tile_size));
  return uvec2(row) & (side.y == 0 ? uvec2(~0u) : side.y < 0 ? uvec2(0u, high_rows) : uvec2(low_rows, 0u));
}

#if KEEPS_NARROW
// Whether a pixel of the tile may have a kernel for a distance up to that one.
bool has_kernels(ivec2 tile, float farthest) {
  ivec2 size = size_of(tile);
  ivec2 at = ivec2(0);
  bool found;
  do {
    ivec2 pixel = lowest_pixel_of(tile) + at;
    float depth = uintBitsToFloat(texelFetch(texels, pixel, 0).y);
    vec3 position = unproject(vec2(pixel) + 0.5, depth);
    vec2 sigma = sigma_for(light_position(position), most_pixels_on_plane(position), farthest);
    // Filters may round in another way.
    found = depth != shadow.sky_depth && !(1.01 * max(sigma.x, sigma.y) < least_sigma);
    at = next_in_rows(at, 0, size.x - 1, 1);
  } while (!found && at.y < size.y);
  return found;
}
#endif

void main() {
  ivec2 last = (ivec2(shadow.viewport.zw) - 1) / tile_size;
  ivec2 first = ivec2(gl_WorkGroupID.xy) * group - 1;
  for (uint i = gl_LocalInvocationIndex; i < blocked.length(); i += group * group) {
    ivec2 tile = first + ivec2(i % around, i / around);
    bool exists = all(greaterThanEqual(tile, ivec2(0))) && all(lessThanEqual(tile, last));
    blocked[i] = exists ? blocked_in(tile) : Blocked(uvec2(0u), 0u);
  }
  barrier();
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThan(tile, last))) return;
  bool changes = false;
  uint farthest = 0u;
  for (int y = -1; y <= 1; ++y) {
    for (int x = -1; x <= 1; ++x) {
      ivec2 place = ivec2(gl_LocalInvocationID.xy) + 1 + ivec2(x, y);
      Blocked near = blocked[place.y * around + place.x];
      if ((near.pixels & pixels_in_reach(ivec2(x, y))) == uvec2(0u)) continue;
      changes = true;
      farthest = max(farthest, near.farthest);
    }
  }
#if KEEPS_NARROW
  changes = changes && has_kernels(tile, half_value(farthest));
#endif
  if (changes) list_tile(tile);
}

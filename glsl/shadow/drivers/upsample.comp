// Interpolates the mask between every n-th pixel. Pixels that these can't stand for are marked, and their tiles listed.
#include "shadow/drivers/gbuffer.glsl"
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"
#include "shadow/shadowed.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0) uniform writeonly restrict image2DArray mask;  // of any format: see Mask
layout(binding = 1, rg32ui) uniform writeonly restrict uimage2D missing_pixels;
layout(binding = 12) uniform sampler2DArray scaled_mask;

uniform int mask_layer;
uniform int scale;

shared uint missing[2];

// A neighbour is on the receiver's surface if it is at most that many widths of a pixel off its plane.
const float most_pixels_off = 0.1;
// Least sum of the weights of such neighbours.
const float least_weight = 0.7;
// Neighbours that differ by more have an edge between them which interpolation would blur.
const float most_difference = 0.25;

// The mean over those of the four nearest computed pixels that show the receiver's surface; false: none of them can
// stand for it.
bool interpolate(ivec2 place, vec3 position, vec3 normal, float depth, out vec4 texel) {
  ivec2 origin = ivec2(shadow.viewport.xy);
  ivec2 last = (ivec2(shadow.viewport.zw) - 1) / scale;
  ivec2 low = place / scale;
  vec2 part = vec2(place - scale * low) / float(scale);
  // Distances from the plane: see plane_distance() in shadow/drivers/filter.glsl.
  vec3 steps = vec3(2.0 / shadow.viewport.zw, shadow.depth_to_ndc.x);
  vec3 view_normal = view_direction(normal);
  vec3 above = (vec4(view_normal, -dot(view_normal, position)) * shadow.clip_to_view).xyz * steps;
  vec3 inverse_w = (vec4(0.0, 0.0, 0.0, 1.0) * shadow.clip_to_view).xyz * steps;
  float own_inverse_w = 1.0 / (shadow.pixel_size.z * position.z + shadow.pixel_size.w);
  float off_plane = most_pixels_off * pixel_width(position);
  float weights = 0.0, least = 1.0, greatest = 0.0;
  texel = vec4(0.0);
  if (any(greaterThan(place, scale * last))) return false;  // beyond the last that were computed
  for (int i = 0; i < 4; ++i) {
    ivec2 to = ivec2(i & 1, i >> 1);
    vec2 of_axes = mix(1.0 - part, part, vec2(to));
    ivec2 tap = min(low + to, last);
    float other = texelFetch(receiver_depth, origin + scale * tap, 0).x;
    vec3 from_receiver = vec3(vec2(scale * tap - place), other - depth);
    float off = dot(above, from_receiver) / (own_inverse_w + dot(inverse_w, from_receiver));
    float weight = abs(off) <= off_plane && other != shadow.sky_depth ? of_axes.x * of_axes.y : 0.0;
    vec4 seen = texelFetch(scaled_mask, ivec3(tap, mask_layer), 0);
    texel.xyz += weight * seen.xyz;
    texel.w = weight > 0.0 ? seen.w : texel.w;
    weights += weight;
    least = weight > 0.0 ? min(least, seen.x) : least;
    greatest = weight > 0.0 ? max(greatest, seen.x) : greatest;
  }
  texel.xyz /= max(weights, least_weight);
  return weights >= least_weight && greatest - least <= most_difference;
}

void main() {
  if (gl_LocalInvocationIndex < 2u) missing[gl_LocalInvocationIndex] = 0u;
  barrier();
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(place, ivec2(shadow.viewport.zw)))) {
    ivec2 pixel = place + ivec2(shadow.viewport.xy);
    vec4 texel = vec4(1.0, 0.0, 0.0, 0.0);
    bool found = true;
    if (!is_sky(pixel)) {
      float depth = texelFetch(receiver_depth, pixel, 0).x;
      vec3 position = unproject(vec2(pixel) + 0.5, depth), normal = light_normal_at(pixel);
      if (faces_light(make_receiver(position, normal, vec2(pixel)))) {
        found = interpolate(place, position, normal, depth, texel);
      } else {
        texel = vec4(0.0);
      }
    }
    if (found) {
      imageStore(mask, ivec3(pixel, mask_layer), texel);
    } else {
      atomicOr(missing[gl_LocalInvocationIndex >> 5], 1u << (gl_LocalInvocationIndex & 31u));
    }
  }
  barrier();
  if (gl_LocalInvocationIndex != 0u) return;
  ivec2 tile = ivec2(gl_WorkGroupID.xy);
  imageStore(missing_pixels, tile, uvec4(missing[0], missing[1], 0u, 0u));
  if ((missing[0] | missing[1]) != 0u) list_tile(tile);
}

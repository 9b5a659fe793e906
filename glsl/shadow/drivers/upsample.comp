// Interpolates the mask between every n-th pixel. Pixels that these can't stand for are listed.
#include "shadow/drivers/gbuffer.glsl"
#include "shadow/drivers/tiles.glsl"
#include "shadow/drivers/tile_lists.glsl"
#include "shadow/drivers/compute_pixels.glsl"
#include "shadow/shadowed.glsl"

layout(binding = 0) uniform writeonly restrict image2DArray mask;  // of any format: see Mask
layout(binding = 8) uniform sampler2D scaled_depth;
layout(binding = 12) uniform sampler2DArray scaled_mask;

uniform int mask_layer;
uniform int scale;

shared uint missing, first_missing;

// A neighbour is on the receiver's surface if it is at most that many widths of a pixel off its plane.
const float most_pixels_off = 0.1;
// Least sum of the weights of such neighbours.
const float least_weight = 0.7;
// Neighbours that differ by more have an edge between them which interpolation would blur.
const float most_difference = 0.25;

// Weights of the four computed pixels around a place that show the surface of its receiver, in textureGather()'s order.
// `part`: from the lowest of them, pixels.
vec4 weights_on_surface(vec2 part, vec4 depths, vec3 position, vec3 normal, float depth) {
  // Distances from the plane: see plane_distance() in shadow/drivers/filter.glsl.
  vec3 steps = vec3(2.0 / shadow.viewport.zw, shadow.depth_to_ndc.x);
  vec3 view_normal = view_direction(normal);
  vec3 above = (vec4(view_normal, -dot(view_normal, position)) * shadow.clip_to_view).xyz * steps;
  vec3 inverse_w = (vec4(0.0, 0.0, 0.0, 1.0) * shadow.clip_to_view).xyz * steps;
  float own_inverse_w = 1.0 / (shadow.pixel_size.z * position.z + shadow.pixel_size.w);
  float side = float(scale);
  vec4 x = vec4(0.0, side, side, 0.0) - part.x, y = vec4(side, side, 0.0, 0.0) - part.y, z = depths - depth;
  vec4 off = above.x * x + above.y * y + above.z * z;
  vec4 inverse = own_inverse_w + inverse_w.x * x + inverse_w.y * y + inverse_w.z * z;
  vec4 on_surface = vec4(lessThanEqual(abs(off), most_pixels_off * pixel_width(position) * abs(inverse)));
  vec2 high = part / side, low = 1.0 - high;
  vec4 weights = vec4(low.x, high.x, high.x, low.x) * vec4(high.y, high.y, low.y, low.y);
  return mix(weights * on_surface, vec4(0.0), equal(depths, vec4(shadow.sky_depth)));
}

// The mean over those of the four nearest computed pixels that show the receiver's surface; false: they can't stand
// for it. A pixel that was computed itself is kept.
bool interpolate(ivec2 place, vec3 position, vec3 normal, float depth, out vec4 texel) {
  ivec2 low = place / scale, rest = place - scale * low;
  vec2 middle = (vec2(low) + 1.0) / vec2(textureSize(scaled_depth, 0));
  vec4 weights = weights_on_surface(vec2(rest), textureGather(scaled_depth, middle), position, normal, depth);
  bool computed = rest == ivec2(0);
  if (computed) weights = vec4(0.0, 0.0, 0.0, 1.0);
  bvec4 counts = greaterThan(weights, vec4(0.0));
  vec4 seen = textureGather(scaled_mask, vec3(middle, float(mask_layer)));
  bvec4 narrow = lessThan(seen, vec4(0.0));
  seen = mix(seen, -1.0 - seen, narrow);
  vec4 lows = mix(vec4(1.0), seen, counts), highs = mix(vec4(0.0), seen, counts);
  float sum = dot(weights, vec4(1.0));
  texel = vec4(dot(weights, highs) / max(sum, least_weight), 0.0, 0.0, 0.0);
#if DETAILS
  for (int i = 0; i < 4; ++i) {
    if (!counts[i]) continue;
    vec4 details = texelFetch(scaled_mask, ivec3(low + ivec2(i == 1 || i == 2, i < 2), mask_layer), 0);
    texel.yz += weights[i] / max(sum, least_weight) * details.yz;
    texel.w = details.w;
  }
#endif
  float difference = max(max(highs.x, highs.y), max(highs.z, highs.w)) - min(min(lows.x, lows.y), min(lows.z, lows.w));
  bool beyond = any(greaterThan(place, (ivec2(shadow.viewport.zw) - 1) / scale * scale));
  bool stands = sum >= least_weight && difference <= most_difference && !beyond;
  bvec4 both = bvec4(vec4(narrow) * vec4(counts));
  return computed || (stands && !any(both));
}

void main() {
  if (gl_LocalInvocationIndex == 0u) missing = 0u;
  barrier();
  ivec2 place = pixel_in_viewport();
  bool found = true;
  if (all(lessThan(place, ivec2(shadow.viewport.zw)))) {
    ivec2 pixel = place + ivec2(shadow.viewport.xy);
    vec4 texel = vec4(1.0, 0.0, 0.0, 0.0);
    if (!is_sky(pixel)) {
      float depth = texelFetch(receiver_depth, pixel, 0).x;
      vec3 position = unproject(vec2(pixel) + 0.5, depth), normal = light_normal_at(pixel);
      if (faces_light(make_receiver(position, normal, vec2(pixel)))) {
        found = interpolate(place, position, normal, depth, texel);
      } else {
        texel = vec4(0.0);
      }
    }
    if (found) imageStore(mask, ivec3(pixel, mask_layer), texel);
  }
  uint index = found ? 0u : atomicAdd(missing, 1u);
  barrier();
  if (gl_LocalInvocationIndex == 0u && missing != 0u) first_missing = extend_pixel_list(missing);
  barrier();
  if (!found) list_pixel(first_missing + index, place);
}

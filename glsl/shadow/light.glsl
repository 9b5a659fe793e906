// Functions that all techniques share: compare texels of a light's shadow map with a receiver.
#include "shadow/light_projection.glsl"
#include "lib/hash.glsl"
#include "lib/disc.glsl"

struct Visibility {
  float visibility;        // 1 lit, 0 in shadow
  float penumbra_radius;   // metres; 0 where there is no blocker
  float blocker_distance;  // mean, along the light, metres; 0 where there is no blocker
  bool under_texel;        // the kernel is smaller than a texel of the map
};

Visibility fully_lit() { return Visibility(1.0, 0.0, 0.0, false); }

// Applies the normal offset bias: moves a receiver along its normal by a fraction of a texel's footprint on it.
Receiver offset_receiver(Receiver receiver, Light light) {
  float cosine = light_cosine(receiver);
  float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  receiver.position += receiver.normal * (bias_normal_offset * texel_size(receiver, light) * sine);
  return receiver;
}

// Bias along the light, metres: the error of rounding, and the parameters bias.constant and bias.slope in texel widths.
float depth_bias(Receiver receiver, Light light) {
  float texels = bias_constant + bias_slope * length(receiver.gradient);
  return depth_rounding(receiver, light) + texel_size(receiver, light) * texels;
}

// How much nearer to the light than the receiver's plane four texels are, metres.
vec4 heights_above(Receiver receiver, vec4 depths, Offsets at) {
  return receiver.position.z + plane_depths(receiver, at) - depths;
}

// The same of the texels so many texels towards +x, +y, -x and -y from a texel; `inside`: from that texel's centre to
// the receiver, in texels.
vec4 heights_beside(Receiver receiver, ivec2 texel, vec2 inside, int distance_to, Light light) {
  vec4 depths =
      vec4(depth_at(texel + ivec2(distance_to, 0), light), depth_at(texel + ivec2(0, distance_to), light),
           depth_at(texel - ivec2(distance_to, 0), light), depth_at(texel - ivec2(0, distance_to), light));
  float size = texel_size(receiver, light), far = float(distance_to);
  return heights_above(receiver, depths, Offsets(size * (vec4(far, 0.0, -far, 0.0) - inside.x),
                                                 size * (vec4(0.0, far, 0.0, -far) - inside.y)));
}

// Slopes of the lit faces beside a receiver, towards +x, +y, -x and -y, as the three texels on each side show them.
// Where two lit faces meet, each lies in front of the other's plane, yet neither blocks the other: texels on such a
// face must not shadow the receiver. A slope is 0 where there is no such face:
//   - Heights above the receiver's plane that increase evenly, or by growing steps, belong to a face or its foot. Those
//     that increase by shrinking steps belong to the edge of an object in front of the receiver.
//   - A face that, extended to the receiver, passes in front of it does block it.
vec4 lit_slopes(Receiver receiver, float bias, Light light) {
  ivec2 at = ivec2(floor(map_place(receiver.position, light)));
  vec2 inside = -texel_offset(receiver, at, light) / texel_size(receiver, light);
  vec4 first = heights_beside(receiver, at, inside, 1, light);
  vec4 second = heights_beside(receiver, at, inside, 2, light);
  vec4 third = heights_beside(receiver, at, inside, 3, light);
  vec4 near = second - first, rise = third - second;
  rise *= step(bias, rise) * step(0.25 * rise, near) * step(near, 1.25 * rise + bias);
  // The faces' heights, extended along their row or column of texels to the receiver's place, and from there across.
  vec4 along = third - rise * (3.0 - vec4(inside, -inside));
  vec2 across = (rise.xy - rise.zw) * inside;
  return step(along + across.yxyx, vec4(bias)) * rise / texel_size(receiver, light);
}

// Tolerance in texel widths: a texel that is in front of the receiver's plane by less still counts as the same surface,
// which may bend within a texel.
const float unresolved_bend = 0.15;

// The receiver with the lit faces beside it filled in from the map. Whatever rises towards the light by more than
// `steepest` metres per metre is a blocker even if it lies on one of these faces.
Receiver with_surroundings(Receiver receiver, float bias, float steepest, Light light) {
  Footprint footprint = fetch_footprint(receiver, vec2(0.0), light);
  vec4 heights = heights_above(receiver, footprint.depths, footprint.offsets);
  float least = min(min(heights.x, heights.y), min(heights.z, heights.w));
  float most = max(max(heights.x, heights.y), max(heights.z, heights.w));
  float texel = texel_size(receiver, light);
  // If all four texels are in front of the plane and show one surface, that surface covers the receiver, which lies
  // between them.
  bool one_surface = abs(heights.x + heights.z - heights.y - heights.w) <= 0.25 * least + bias;
  bool nearer = any(lessThan(footprint.depths, vec4(receiver.position.z - bias)));
  float bend = unresolved_bend * texel * length(receiver.gradient);
  receiver.surroundings.slopes = lit_slopes(receiver, bias, light);
  receiver.surroundings.steepest = steepest;
  receiver.surroundings.covered = least > bias && one_surface && nearer ? 1.5 * texel : 0.0;
  receiver.surroundings.unresolved = least <= bias && most <= bias + bend ? bend : 0.0;
  return receiver;
}

// Depths below which texels at those offsets are blockers.
vec4 blocking_depths_at(Receiver receiver, Offsets at, float bias) {
  return blocking_depths(receiver.position.z, plane_depths(receiver, at), receiver.surroundings, at.x, at.y, bias);
}

// 1 for each texel of a footprint that blocks, else 0.
vec4 blocking_texels(Receiver receiver, Footprint footprint, float bias) {
  return vec4(lessThan(footprint.depths, blocking_depths_at(receiver, footprint.offsets, bias)));
}

float bilinear(vec4 texels, vec2 weight) {
  vec2 rows = mix(texels.wx, texels.zy, weight.x);
  return mix(rows.x, rows.y, weight.y);
}

// Visibility at a point of the map: percentage-closer filtering of the four texels around it (Reeves et al. 1987,
// "Rendering antialiased shadows with depth maps").
float lit_share(Receiver receiver, vec2 offset, float bias, Light light) {
  Footprint footprint = fetch_footprint(receiver, offset, light);
  return 1.0 - bilinear(blocking_texels(receiver, footprint, bias), footprint.weight);
}

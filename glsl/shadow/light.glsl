// Functions that all techniques share: compare texels of a light's shadow map with a receiver.
#include "shadow/light_projection.glsl"
#include "lib/hash.glsl"
#include "lib/disc.glsl"

struct Visibility {
  float visibility;        // 1 lit, 0 in shadow
  float penumbra_radius;   // metres; 0 where there is no blocker
  float blocker_distance;  // mean, along the light, metres; 0 where there is no blocker
  bool under_texel;        // the kernel is smaller than a texel of the map
  bool noise_free;         // filters leave it as it is
};

Visibility fully_lit() { return Visibility(1.0, 0.0, 0.0, false, false); }

Visibility without_noise(Visibility seen) {
  seen.noise_free = true;
  return seen;
}

// The half width, metres, of the square that stands for the light's shape of that radius: that of a disc has the same
// variance.
float square_half(float radius, Light light) { return light.square ? radius : 0.8660254 * radius; }

// Applies the normal offset bias: moves a receiver along its normal by a fraction of a texel's footprint on it.
Receiver offset_receiver(Receiver receiver, Light light) {
  float cosine = light_cosine(receiver);
  float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  float offset = bias_normal_offset * texel_size(receiver, light) * sine;
  receiver.position += along_rays(receiver, receiver.normal * offset);
  return receiver;
}

// Bias along the light, metres: the error of rounding, and the parameters bias.constant and bias.slope in texel widths.
float depth_bias(Receiver receiver, Light light) {
  float texels = bias_constant + bias_slope * texel_slope(receiver, light);
  return depth_rounding(receiver, light) + texel_size(receiver, light) * texels;
}

// How much nearer to the light than the receiver's plane four texels are, metres.
vec4 heights_above(Receiver receiver, vec4 depths, Offsets at) {
  return receiver.position.z + plane_depths(receiver, at) - depths;
}

// A lit face beside a receiver, reconstructed from the map's texels on one side.
struct Face {
  float rise;    // of its height above the receiver's plane with each texel away from the receiver; 0: there is no face
  float height;  // continued to the receiver, along the texels' row or column
};

// The face shown by the depths of the three texels next to the receiver's own, nearest first. Heights that increase
// evenly, or by growing steps, belong to a face or its foot. Heights that increase by shrinking steps belong to the
// edge of an object in front of the receiver.
Face face_beside(Receiver receiver, ivec2 at, ivec2 side, vec3 depths, float bias, Light light) {
  vec2 first = texel_offset(receiver, at + side, light);
  vec2 next = vec2(side) * texel_extent(receiver, light);
  Offsets offsets = Offsets(first.x + next.x * vec4(0.0, 1.0, 2.0, 2.0), first.y + next.y * vec4(0.0, 1.0, 2.0, 2.0));
  vec3 heights = heights_above(receiver, depths.xyzz, offsets).xyz;
  float near = heights.y - heights.x;
  float rise = heights.z - heights.y;
  if (rise <= bias || near < 0.25 * rise || near > 1.25 * rise + bias) return Face(0.0, 0.0);
  return Face(rise, heights.z - rise * (2.0 + dot(first, next) / dot(next, next)));
}

// Slopes of the lit faces beside a receiver, along x and y. Where two lit faces meet, each lies in front of the other's
// plane, yet neither blocks the other: texels on such a face must not shadow the receiver. The slope is 0 for a face
// that, extended to the receiver, passes in front of it and so does block it.
vec4 lit_slopes(Receiver receiver, float bias, Light light) {
  ivec2 at = ivec2(floor(map_place(receiver.position, light)));
  vec4 right_up = depths_from(at, light);
  vec4 left_down = depths_from(at - 1, light);
  vec4 far_right = depths_from(at + ivec2(2, 0), light);
  vec4 far_up = depths_from(at + ivec2(0, 2), light);
  vec4 far_left = depths_from(at - ivec2(3, 0), light);
  vec4 far_down = depths_from(at - ivec2(0, 3), light);
  Face right = face_beside(receiver, at, ivec2(1, 0), vec3(right_up.z, far_right.wz), bias, light);
  Face up = face_beside(receiver, at, ivec2(0, 1), vec3(right_up.x, far_up.wx), bias, light);
  Face left = face_beside(receiver, at, ivec2(-1, 0), vec3(left_down.x, far_left.zw), bias, light);
  Face down = face_beside(receiver, at, ivec2(0, -1), vec3(left_down.z, far_down.xw), bias, light);
  // From the row of texels to the receiver's, and from their column to the receiver's.
  vec2 texel = texel_extent(receiver, light);
  vec2 to_receiver = -texel_offset(receiver, at, light) / texel;
  vec2 across = vec2(right.rise - left.rise, up.rise - down.rise) * to_receiver;
  vec4 heights = vec4(right.height, up.height, left.height, down.height) + across.yxyx;
  return step(heights, vec4(bias)) * vec4(right.rise, up.rise, left.rise, down.rise) / texel.xyxy;
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
  float bend = unresolved_bend * texel * texel_slope(receiver, light);
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

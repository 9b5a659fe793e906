// What every technique does with a light's map: compare texels with a receiver.
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

// A receiver as the layer's bias rules move it: along its normal by a part of a texel's shadow on it.
Receiver offset_receiver(Receiver receiver, Light light) {
  float cosine = light_cosine(receiver);
  float sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  receiver.position += receiver.normal * (bias_normal_offset * texel_size(receiver, light) * sine);
  return receiver;
}

// Bias along the light, metres: what rounding needs, and a part of the texel's depth range on the receiver's plane.
float depth_bias(Receiver receiver, Light light) {
  return depth_rounding(light) + texel_size(receiver, light) * (bias_constant + bias_slope * length(receiver.gradient));
}

// How much nearer to the light the surface beside the receiver gets with each metre towards one side. 0 unless the next
// three texels rise, not less and less, as a face or the foot of one does, and their surface, continued to the
// receiver, passes behind it.
float side_slope(Receiver receiver, ivec2 at, ivec2 side, float texels, float bias, Light light) {
  float first = depth_at(at + side, light);
  float second = depth_at(at + 2 * side, light);
  float near = first - second;
  float far = second - depth_at(at + 3 * side, light);
  float rise = min(near, far);
  bool continues = rise > 0.0 && near <= 1.25 * far + bias;
  bool behind = first + rise * texels >= receiver.position.z - bias;
  return continues && behind ? rise / texel_size(receiver, light) : 0.0;
}

// Where lit faces meet in a corner each lies before the other's plane, and yet neither hides the other: a receiver next
// to another face must not be shadowed by what lies on that face's plane either. What rises by more than `steepest`
// metres with each metre blocks all the same.
Receiver receiver_in_corner(Receiver receiver, float bias, float steepest, Light light) {
  vec2 place = map_place(receiver.position, light.layer);
  ivec2 at = ivec2(floor(place));
  vec2 high = vec2(at) + 1.5 - place;
  vec2 low = place - vec2(at) + 0.5;
  vec4 own = max(vec4(-receiver.gradient, receiver.gradient), 0.0);
  vec4 slopes = vec4(side_slope(receiver, at, ivec2(1, 0), high.x, bias, light),
                     side_slope(receiver, at, ivec2(0, 1), high.y, bias, light),
                     side_slope(receiver, at, ivec2(-1, 0), low.x, bias, light),
                     side_slope(receiver, at, ivec2(0, -1), low.y, bias, light));
  bool meets = any(greaterThan(slopes, own * 1.01 + bias / texel_size(receiver, light)));
  receiver.corner = Corner(meets ? max(slopes, own) : vec4(0.0), steepest);
  return receiver;
}

// Depths before which texels at those offsets block.
vec4 blocking_depths_at(Receiver receiver, Offsets at, float bias) {
  return blocking_depths(receiver.position.z, plane_depths(receiver, at), receiver.corner, at.x, at.y, bias);
}

// 1 for each texel of a footprint that blocks, else 0.
vec4 blocking_texels(Receiver receiver, Footprint footprint, float bias) {
  return vec4(lessThan(footprint.depths, blocking_depths_at(receiver, footprint.offsets, bias)));
}

float bilinear(vec4 texels, vec2 weight) {
  vec2 rows = mix(texels.wx, texels.zy, weight.x);
  return mix(rows.x, rows.y, weight.y);
}

// Share of light that passes a point of the map: percentage-closer filtering of the four texels about it (Reeves et al.
// 1987, "Rendering antialiased shadows with depth maps").
float lit_share(Receiver receiver, vec2 offset, float bias, Light light) {
  Footprint footprint = fetch_footprint(receiver, offset, light);
  return 1.0 - bilinear(blocking_texels(receiver, footprint, bias), footprint.weight);
}

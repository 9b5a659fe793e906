// Functions for filters. Each filter's file includes this one and defines
//   uint filtered(ivec2 pixel);
#include "shadow/drivers/gbuffer.glsl"
#include "shadow/drivers/kernel.glsl"
#include "lib/packed_texel.glsl"

// The packed texel and the stored depth of a pixel, which must be within the viewport and within Filter::border of the
// filtered one. The drivers define these functions.
uint texel_at(ivec2 pixel);
float stored_depth_at(ivec2 pixel);

const int filter_pass = FILTER_PASS;

// Pixels of the picture from one that is filtered to the next along rows and columns: see mask.scale.
uniform int mask_scale;

ivec2 lowest_pixel() { return ivec2(shadow.viewport.xy); }
ivec2 highest_pixel() { return ivec2(shadow.viewport.xy + shadow.viewport.zw) - 1; }

bool is_sky_depth(float depth) { return depth == shadow.sky_depth; }

// A texel with another visibility.
uint with_visibility(uint texel, float visibility) {
  return (texel & ~visibility_bits) | (pack_texel(0.0, visibility, false) & visibility_bits);
}

// The plane of a pixel's receiver, for measuring its neighbours' distances from it.
struct Surface {
  vec3 position;    // light space
  float depth;      // as stored
  vec3 above;       // see plane_distance()
  vec3 inverse_w;   // the same
  float own_inverse_w;
  vec2 pixels;      // per metre on the plane, along x and along y
};

// A point q that is seen at clip-space position c has q = Q.xyz / Q.w with Q = clip_to_view · c, so its distance from
// the plane (n, −n·p) is (n, −n·p)·Q / Q.w: a quotient of two linear forms in pixel offset and stored depth, of which
// the first is 0 and the second 1 / clip w at the receiver itself.
Surface surface_at(ivec2 pixel) {
  float depth = stored_depth_at(pixel);
  vec3 at = unproject(vec2(pixel) + 0.5, depth);
  vec3 normal = view_direction(light_normal_at(pixel));
  float clip_w = shadow.pixel_size.z * at.z + shadow.pixel_size.w;
  vec2 size = abs(shadow.pixel_size.xy * clip_w);
  vec3 step_of = vec3(2.0 / shadow.viewport.zw, shadow.depth_to_ndc.x);
  vec3 above = (vec4(normal, -dot(normal, at)) * shadow.clip_to_view).xyz * step_of;
  vec3 inverse_w = (vec4(0.0, 0.0, 0.0, 1.0) * shadow.clip_to_view).xyz * step_of;
  return Surface(light_position(at), depth, above / (filter_edge * max(size.x, size.y)), inverse_w,
                 1.0 / clip_w, pixels_on_plane(at, normal));
}

// Distance of a neighbour from the receiver's plane, in units of filter.edge pixels at the receiver. Not for sky
// pixels.
float plane_distance(Surface surface, ivec2 offset, float depth) {
  vec3 from_receiver = vec3(vec2(offset), depth - surface.depth);
  return dot(surface.above, from_receiver) / (surface.own_inverse_w + dot(surface.inverse_w, from_receiver));
}

// Mean blocker distance, metres, of a texel that was blended with its history if there is one.
float blended_distance(uint texel) { return counts_frames() ? half_value(texel & 0x7ff0u) : texel_distance(texel); }

// How much narrower a kernel is than a single frame's, for as little noise as is left in so many: their error falls
// with the square root of their number.
float narrowing(uint texel) {
  return counts_frames() ? inversesqrt(float(max(texel_frames(texel), 1u))) : 1.0;
}

// Mean blocker distance from which a kernel size is computed, metres, of a texel; 0: it has none, or no noise.
float noisy_distance(uint texel) { return is_noise_free(texel) ? 0.0 : blended_distance(texel); }

// The same of a pixel; 0: the pixel is not filtered. A pixel that found no blocker may still lie in a penumbra, since
// few taps often miss a blocker that covers little of the light; then the neighbours that found one decide.
float kernel_distance(ivec2 pixel, uint texel) {
  float own = noisy_distance(texel);
  float sum = own;
  float found = own > 0.0 ? 1.0 : 0.0;
  // Not a constant, so that compilers do not unroll the loop: unrolled, its reads would cost time even where it is
  // skipped.
  ivec2 move = ivec2(1, 2);
  int count = own > 0.0 || is_noise_free(texel) || is_sky_depth(stored_depth_at(pixel)) ? 0 : 8;
  for (int i = 0; i < count; ++i) {
    float of_neighbour = noisy_distance(texel_at(clamp(pixel + move, lowest_pixel(), highest_pixel())));
    sum += of_neighbour;
    found += of_neighbour > 0.0 ? 1.0 : 0.0;
    move = i == 3 ? ivec2(2, 1) : ivec2(-move.y, move.x);
  }
  return found > 0.0 ? sum / found * narrowing(texel) : 0.0;
}

// Standard deviation of a pixel's kernel along x and y, pixels.
vec2 kernel_sigma(Surface surface, float distance_to) {
  return sigma_for(surface.position, surface.pixels, distance_to);
}

// Taps on a line of pixels through the filtered one: itself, and others evenly spaced over `radius`, at most
// filter.taps to a side, within the viewport. Per-pixel noise falls with the square root of their number: 6 taps to a
// side reduce it to a tenth over both axes, less than the error of blurring itself. Blue noise is better than white
// only if all pixels are read. With the same offsets at every pixel their lattice would be visible, so each pixel
// shifts them.
struct TapLine {
  int first, last;
  float spacing;  // pixels, at least 1
  float shift;    // pixels, less than half the spacing; 0 where no pixels are skipped
  float radius;   // pixels
};

// Interleaved gradient noise (Jimenez 2014, "Next generation post processing in Call of Duty: Advanced Warfare").
float tap_noise(ivec2 pixel, int axis) {
  ivec2 at = pixel - lowest_pixel();
  return fract(52.9829189 * fract(dot(vec2(axis == 0 ? at : at.yx), vec2(0.06711056, 0.00583715))));
}

TapLine taps_along(int axis, ivec2 pixel, float radius) {
  float spacing = max(radius / float(filter_taps), 1.0);
  float shift = (tap_noise(pixel, axis) - 0.5) * (spacing - 1.0);
  int side = int(radius / spacing + 0.5);
  int below = int((float(pixel[axis] - lowest_pixel()[axis]) + shift) / spacing);
  int above = int((float(highest_pixel()[axis] - pixel[axis]) - shift) / spacing);
  return TapLine(-min(side, below), min(side, above), spacing, shift, radius);
}

// Stays within the radius even when shifted, because a work group shares no pixels beyond it.
int tap_offset(TapLine taps, int index) {
  float offset = float(index) * taps.spacing + taps.shift;
  return index == 0 ? 0 : int(roundEven(clamp(offset, -taps.radius, taps.radius)));
}

ivec2 along(int axis, int offset) { return axis == 0 ? ivec2(offset, 0) : ivec2(0, offset); }

// Gaussian mean over the pixels of a row (axis 0) or column (1) that lie on the receiver's plane. `distance_to`: the
// blocker distance that belongs to sigma. Neighbours with a shorter one weigh as in the narrower kernel of their own,
// so that narrow penumbrae are not spread over wide ones. 0: all weigh as in the pixel's kernel.
float mean_on_axis(int axis, ivec2 pixel, Surface surface, float sigma, float distance_to) {
  TapLine taps = taps_along(axis, pixel, 2.0 * sigma);
  float falloff = -0.5 / (sigma * sigma);
  float sum = 0.0;
  float weights = 0.0;
  int i = taps.first;
  do {
    int offset = tap_offset(taps, i);
    ivec2 to = along(axis, offset);
    float depth = stored_depth_at(pixel + to);
    float off_plane = plane_distance(surface, to, depth);
    uint texel = texel_at(pixel + to);
    float own_distance = blended_distance(texel) * narrowing(texel);
    float narrower = own_distance > 0.0 ? max(distance_to / own_distance, 1.0) : 1.0;
    float apart = narrower * float(offset);
    float weight = exp(falloff * apart * apart - 0.5 * off_plane * off_plane);
    weight = is_sky_depth(depth) ? 0.0 : weight;
    sum += weight * texel_visibility(texel);
    weights += weight;
  } while (++i <= taps.last);
  return sum / weights;
}

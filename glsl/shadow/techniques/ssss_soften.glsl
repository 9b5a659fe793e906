// Softens the hard shadow of a pixel by those of its neighbours in the picture. See docs/techniques.md.
#include "shadow/sampling.glsl"
#include "shadow/drivers/gbuffer.glsl"
#include "shadow/shadowed.glsl"

layout(binding = 8) uniform sampler2DArray hard_shadow;  // what ssss.glsl computes, with channels as in a mask

// The receiver of a pixel, and the map from offsets on its plane to the picture.
struct Surface {
  Receiver receiver;
  vec3 position;          // view space
  vec3 normal;            // the same
  vec3 along_x, along_y;  // view space: a step on the plane by 1 m along the light's x or y
  vec2 place;             // shown_at() of the position
  vec2 longest;           // unit vector of the light's x and y along which a metre on the plane covers most pixels
  float pixels;           // how many
};

float clip_w(vec3 position) { return shadow.pixel_size.z * position.z + shadow.pixel_size.w; }

// Where the picture shows a point in view space, pixels plus a constant, if the point is not behind the camera.
vec2 shown_at(vec3 position) { return position.xy / (shadow.pixel_size.xy * clip_w(position)); }

Surface surface_at(ivec2 pixel) {
  Surface surface;
  surface.receiver = receiver_at(pixel);
  surface.position = view_position_of(surface.receiver);
  surface.normal = view_normal_of(surface.receiver);
  surface.along_x = view_direction(vec3(1.0, 0.0, surface.receiver.gradient.x));
  surface.along_y = view_direction(vec3(0.0, 1.0, surface.receiver.gradient.y));
  surface.place = shown_at(surface.position);
  // The larger singular value of the Jacobian, which differences over a fraction of a pixel give.
  float small = 0.1 * pixel_width(surface.position);
  vec2 x = (shown_at(surface.position + small * surface.along_x) - surface.place) / small;
  vec2 y = (shown_at(surface.position + small * surface.along_y) - surface.place) / small;
  vec2 twice = vec2(dot(x, x) - dot(y, y), 2.0 * dot(x, y));
  float angle = twice == vec2(0.0) ? 0.0 : 0.5 * atan(twice.y, twice.x);
  surface.longest = vec2(cos(angle), sin(angle));
  surface.pixels = length(mat2(x, y) * surface.longest);
  return surface;
}

// By how much offsets within a radius are shortened along surface.longest to cover at most ssss.most_pixels.
float shortening(Surface surface, float radius) { return min(1.0, ssss_most_pixels / (surface.pixels * radius)); }

// The pixel that shows a point of the plane at an offset in the light's x and y, metres. Not in the viewport if the
// point is behind the camera, or if perspective takes it farther than ssss.most_pixels away.
ivec2 pixel_at(Surface surface, vec2 offset, float shorter) {
  offset -= (1.0 - shorter) * dot(offset, surface.longest) * surface.longest;
  vec3 to = surface.position + offset.x * surface.along_x + offset.y * surface.along_y;
  if (clip_w(to) <= 0.0) return ivec2(-1);
  vec2 moved = shown_at(to) - surface.place;
  if (length(moved) > ssss_most_pixels) return ivec2(-1);
  return ivec2(floor(surface.receiver.pixel + 0.5 + moved));
}

bool in_viewport(ivec2 pixel) {
  ivec2 at = pixel - ivec2(shadow.viewport.xy);
  return all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, ivec2(shadow.viewport.zw)));
}

// Whether a pixel that is not lit is so because something blocks the light, not because it faces away from it.
bool has_blocker(vec4 hard) { return hard.x < 1.0 && hard.z > 0.0; }

// Bound of the relative error of a blocker distance, which is stored as a half float.
const float distance_rounding = 1.0 / 1024.0;

// Length of an offset in the light's x and y by which its shape is a disc of radius 1.
float shape_length(vec2 offset, Light light) {
  return is_square(light) ? max(abs(offset.x), abs(offset.y)) : length(offset);
}

struct Blockers {
  float height_sum;  // metres along the light
  float weight;
};

// Adds what blocks a pixel, if it lies within the cone from the receiver to the light. The pixel may belong to another
// surface: where its blocker is in light space is known all the same.
void add_blocker(inout Blockers blockers, Surface surface, ivec2 pixel, float bias, float slack, Light light) {
  if (!in_viewport(pixel)) return;
  vec4 hard = texelFetch(hard_shadow, ivec3(pixel, 0), 0);
  if (!has_blocker(hard)) return;
  vec3 blocker = light_position(view_position_at(pixel)) - vec3(0.0, 0.0, hard.z);
  vec3 to = blocker - surface.receiver.position;
  float height = -to.z;
  float above_plane = dot(surface.receiver.gradient, to.xy) - to.z;
  if (min(height, above_plane) <= bias + distance_rounding * hard.z) return;
  if (shape_length(to.xy, light) > penumbra_radius(surface.receiver, height, light) + slack) return;
  blockers.height_sum += (1.0 - hard.x) * height;
  blockers.weight += 1.0 - hard.x;
}

// Mean distance, metres along the light, of the blockers of pixels whose places on the receiver's plane are within the
// radius; 0: there is none.
float mean_blocker_distance(Surface surface, ivec2 pixel, float radius, Light light) {
  float bias = depth_bias(surface.receiver, light);
  float slack = 0.5 * (pixel_width(surface.position) + texel_size(surface.receiver, light));
  Scramble scramble = blocker_scramble(surface.receiver);
  float shorter = shortening(surface, radius);
  Blockers blockers = Blockers(0.0, 0.0);
  add_blocker(blockers, surface, pixel, bias, slack, light);
  int i = 0;
  do {
    ivec2 at = pixel_at(surface, radius * blocker_point(i, scramble, light), shorter);
    add_blocker(blockers, surface, at, bias, slack, light);
  } while (++i < ssss_search_taps);
  return blockers.weight > 0.0 ? blockers.height_sum / blockers.weight : 0.0;
}

// Weight of a pixel in the filter, 0 to 1: by its distance from the receiver's plane and by its normal. A surface that
// bends by an angle leaves the plane by no more than the distance times the angle's sine.
float bilateral_weight(Surface surface, ivec2 pixel) {
  vec3 to = view_position_at(pixel) - surface.position;
  float cosine = clamp(dot(view_direction(light_normal_at(pixel)), surface.normal), 0.0, 1.0);
  float allowed = ssss_edge * pixel_width(surface.position) + sqrt(1.0 - cosine * cosine) * length(to);
  float turn = (1.0 - cosine) / max(1.0 - cos(radians(ssss_turn)), 1e-6);
  return clamp(2.0 - abs(dot(surface.normal, to)) / allowed, 0.0, 1.0) * clamp(2.0 - turn, 0.0, 1.0);
}

struct Sum {
  float lit;
  float weight;
};

// A pixel of another surface that lies below the receiver's plane shows whether the light that goes there passes the
// plane. It does not if what blocks the pixel is above the plane.
void add_other_surface(inout Sum sum, Surface surface, ivec2 pixel, vec4 hard, float radius, float share, Light light) {
  vec3 to = light_position(view_position_at(pixel)) - surface.receiver.position;
  float below_plane = to.z - dot(surface.receiver.gradient, to.xy);
  if (below_plane < 0.0 || shape_length(to.xy, light) > radius) return;
  bool blocks = below_plane < (1.0 - distance_rounding) * hard.z;
  sum.lit += share * (blocks ? hard.x : 1.0);
  sum.weight += share;
}

// The mean of the hard shadow over the pixels that show the disc around the receiver on its plane.
float softened(Surface surface, float own, float radius, Light light) {
  Scramble scramble = filter_scramble(surface.receiver);
  float shorter = shortening(surface, radius);
  Sum sum = Sum(0.0, 0.0);
  int i = 0;
  do {
    ivec2 at = pixel_at(surface, radius * filter_point(i, scramble, light), shorter);
    if (!in_viewport(at) || is_sky(at)) continue;
    vec4 hard = texelFetch(hard_shadow, ivec3(at, 0), 0);
    if (hard.x < 1.0 && !has_blocker(hard)) continue;
    float weight = bilateral_weight(surface, at);
    sum.lit += weight * hard.x;
    sum.weight += weight;
    if (weight < 1.0) add_other_surface(sum, surface, at, hard, radius, 1.0 - weight, light);
  } while (++i < ssss_taps);
  return sum.weight > 0.0 ? sum.lit / sum.weight : own;
}

// See Mask in the library's headers.
vec4 soft_pixel(ivec2 pixel) {
  vec4 hard = texelFetch(hard_shadow, ivec3(pixel, 0), 0);
  // Of the sky, of surfaces that face away, and of pixels that no penumbra reaches, the hard shadow is exact.
  if (is_sky(pixel) || (hard.x < 1.0 && !has_blocker(hard))) return vec4(hard.x, 0.0, 0.0, hard.w);
  Surface surface = surface_at(pixel);
  Light light = with_layer(frame_light(), int(hard.w));
  float distance_to = hard.y > 0.0 ? mean_blocker_distance(surface, pixel, hard.y, light) : hard.z;
  float radius = penumbra_radius(surface.receiver, distance_to, light);
  float visible = hard.y > 0.0 && radius > 0.0 ? softened(surface, hard.x, radius, light) : hard.x;
  bool under_texel = distance_to > 0.0 && radius < texel_size(surface.receiver, light);
  return mask_texel(Shadowed(Visibility(visible, radius, distance_to, under_texel, false), light.layer, false));
}

// Softens the hard shadow of a pixel by those of its neighbours in the picture. See docs/techniques.md.
#include "shadow/sampling.glsl"
#include "shadow/drivers/gbuffer.glsl"
#include "shadow/shadowed.glsl"

layout(binding = 8) uniform sampler2DArray hard_shadow;  // what ssss.glsl computes, with layers as in a mask

// The receiver of a pixel, with what maps offsets on its plane to pixels.
struct Surface {
  Receiver receiver;
  vec3 position;        // view space
  vec3 normal;          // the same
  vec3 along_x, along_y;  // view space: a step on the plane of 1 m along the light's x or y
  vec2 pixel;           // where the picture shows it
  vec2 longest;         // unit vector of the light's x and y along which a metre on the plane covers most pixels
  float pixels;         // how many
};

// The pixel at which the picture shows a point in view space, plus a constant. Not for points behind the camera.
vec2 shown_at(vec3 position) {
  return position.xy / (shadow.pixel_size.xy * (shadow.pixel_size.z * position.z + shadow.pixel_size.w));
}

Surface surface_at(ivec2 pixel) {
  Surface surface;
  surface.position = view_position_at(pixel);
  surface.receiver = make_receiver(surface.position, light_normal_at(pixel), vec2(pixel));
  surface.normal = view_normal_of(surface.receiver);
  surface.along_x = view_direction(vec3(1.0, 0.0, surface.receiver.gradient.x));
  surface.along_y = view_direction(vec3(0.0, 1.0, surface.receiver.gradient.y));
  surface.pixel = shown_at(surface.position);
  // The Jacobian of the map from offsets to pixels, by differences over a pixel's width; its larger singular value.
  float small = pixel_width(surface.position);
  vec2 x = (shown_at(surface.position + small * surface.along_x) - surface.pixel) / small;
  vec2 y = (shown_at(surface.position + small * surface.along_y) - surface.pixel) / small;
  float angle = 0.5 * atan(2.0 * dot(x, y), dot(x, x) - dot(y, y));
  surface.longest = vec2(cos(angle), sin(angle));
  surface.pixels = length(mat2(x, y) * surface.longest);
  return surface;
}

// How much offsets within a radius are shortened along surface.longest, so that they cover at most ssss.most_pixels.
float shortening(Surface surface, float radius) { return min(1.0, ssss_most_pixels / (surface.pixels * radius)); }

// The pixel that shows a point of the plane at an offset in the light's x and y, metres.
ivec2 pixel_at(Surface surface, vec2 offset, float shorter) {
  offset -= (1.0 - shorter) * dot(offset, surface.longest) * surface.longest;
  vec3 to = surface.position + offset.x * surface.along_x + offset.y * surface.along_y;
  return ivec2(floor(surface.receiver.pixel + 0.5 + shown_at(to) - surface.pixel));
}

bool in_viewport(ivec2 pixel) {
  ivec2 at = pixel - ivec2(shadow.viewport.xy);
  return all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, ivec2(shadow.viewport.zw)));
}

// Mean blocker distance.

struct Blockers {
  float height_sum;  // metres along the light
  float weight;
};

// Adds the blocker of a pixel in shadow, if it lies within the cone from the receiver to the light. It need not be on
// the receiver's surface: its place in light space is known.
void add_blocker(inout Blockers blockers, Surface surface, ivec2 pixel, float slack, float weight, Light light) {
  if (!in_viewport(pixel)) return;
  vec4 hard = texelFetch(hard_shadow, ivec3(pixel, 0), 0);
  if (hard.z <= 0.0 || hard.x >= 1.0) return;
  vec3 blocker = light_position(view_position_at(pixel)) - vec3(0.0, 0.0, hard.z);
  vec3 from_receiver = blocker - surface.receiver.position;
  float height = -from_receiver.z;
  float above_plane = dot(surface.receiver.gradient, from_receiver.xy) + height;
  vec2 aside = abs(from_receiver.xy);
  float beside = is_square(light) ? max(aside.x, aside.y) : length(aside);
  if (min(height, above_plane) <= 0.0) return;
  if (beside > penumbra_radius(surface.receiver, height, light) + slack) return;
  blockers.height_sum += weight * (1.0 - hard.x) * height;
  blockers.weight += weight * (1.0 - hard.x);
}

// 0: there is none.
float mean_blocker_distance(Surface surface, ivec2 pixel, float radius, Light light) {
  float slack = 0.5 * (pixel_width(surface.position) + texel_size(surface.receiver, light));
  Scramble scramble = blocker_scramble(surface.receiver);
  float shorter = shortening(surface, radius);
  Blockers blockers = Blockers(0.0, 0.0);
  add_blocker(blockers, surface, pixel, slack, 0.5, light);
  for (int i = 0; i < ssss_search_taps; ++i) {
    vec2 point = blocker_point(i, scramble, light);
    // More taps near the pixel, where those that lie in the cone of a low blocker are; each with its share of the area.
    float away = length(point);
    add_blocker(blockers, surface, pixel_at(surface, radius * away * point, shorter), slack, away, light);
  }
  return blockers.weight > 0.0 ? blockers.height_sum / blockers.weight : 0.0;
}

// Filter.

// Weight of a pixel in the filter: 0 to 1, by its distance from the receiver's plane and by its normal. A surface that
// bends by an angle leaves the plane by no more than its sine times the distance.
float bilateral_weight(Surface surface, ivec2 pixel) {
  vec3 normal = view_direction(light_normal_at(pixel));
  vec3 to = view_position_at(pixel) - surface.position;
  float cosine = clamp(dot(normal, surface.normal), 0.0, 1.0);
  float allowed = ssss_edge * pixel_width(surface.position) + sqrt(1.0 - cosine * cosine) * length(to);
  float by_plane = clamp(2.0 - abs(dot(surface.normal, to)) / allowed, 0.0, 1.0);
  float by_normal = clamp(2.0 - (1.0 - cosine) / max(1.0 - ssss_turn, 1e-6), 0.0, 1.0);
  return by_plane * by_normal;
}

float softened(Surface surface, ivec2 pixel, float own, float radius, Light light) {
  Scramble scramble = filter_scramble(surface.receiver);
  float shorter = shortening(surface, radius);
  float sum = 0.0, weights = 0.0;
  for (int i = 0; i < ssss_taps; ++i) {
    ivec2 at = pixel_at(surface, radius * filter_point(i, scramble, light), shorter);
    if (!in_viewport(at) || is_sky(at)) continue;
    vec4 hard = texelFetch(hard_shadow, ivec3(at, 0), 0);
    if (hard.x < 1.0 && hard.z <= 0.0) continue;  // its surface faces away from the light
    float weight = bilateral_weight(surface, at);
    sum += weight * hard.x;
    weights += weight;
  }
  return weights > 0.0 ? sum / weights : own;
}

// See Mask in the library's headers.
vec4 soft_pixel(ivec2 pixel) {
  vec4 hard = texelFetch(hard_shadow, ivec3(pixel, 0), 0);
  bool faces = hard.x >= 1.0 || hard.z > 0.0;
  if (is_sky(pixel) || !faces) return vec4(hard.x, 0.0, 0.0, hard.w);
  Surface surface = surface_at(pixel);
  Light light = with_layer(frame_light(), int(hard.w));
  float distance_to = hard.z;
  float visible = hard.x;
  if (hard.y > 0.0) {
    distance_to = mean_blocker_distance(surface, pixel, hard.y, light);
    float radius = penumbra_radius(surface.receiver, distance_to, light);
    if (radius > 0.0) visible = softened(surface, pixel, hard.x, radius, light);
  }
  float radius = penumbra_radius(surface.receiver, distance_to, light);
  bool under_texel = distance_to > 0.0 && radius < texel_size(surface.receiver, light);
  return mask_texel(Shadowed(Visibility(visible, radius, distance_to, under_texel), light.layer));
}

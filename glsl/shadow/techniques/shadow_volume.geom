// The faces of a triangle's shadow volume that the camera sees from inside: behind each receiver in the volume there is
// one of them. The volume is a prism, of a lamp a frustum: it begins at the triangle, its sides are the light's rays
// through the edges, and it ends where all of these have left the receivers' box. All of it is a little larger than it
// should be, so that the rasteriser misses no pixel; the fragment shader decides each pixel. LAMP: 1 for a lamp.
#include "shadow/techniques/shadow_volume.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 24) out;

// The triangle's corners, in an order that depends on their positions alone.
flat out vec3 corner_a, corner_b, corner_c;

const float largest_miter = 1e5;  // margins that a corner moves at most: it can be sharp
const float longest_lead = 1e5;   // margins that it then moves along the ray at most
const float overhang = 64.0;      // margins by which a volume reaches beyond the receivers
const float longest = 1e9;        // times a frustum's end is as large as its beginning at most

bool precedes(vec3 a, vec3 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z; }

vec3 unit(vec3 v) { return v / max(length(v), 1e-30); }

// The ray's direction at a corner, away from the light.
vec3 ray_at(vec3 corner) { return -unit(towards_light(corner)); }

vec3 across(vec3 way, vec3 ray) { return unit(way - dot(way, ray) * ray); }

// By how much a corner moves across its ray if both edges at it move outwards by 1. Seen from the light, the triangle's
// corners are in counter-clockwise order.
vec3 miter(vec3 previous, vec3 corner, vec3 next, vec3 ray) {
  vec3 from_next = across(corner - next, ray), from_previous = across(corner - previous, ray);
  vec3 apart = from_next - from_previous;
  float half_sine = 0.5 * length(apart);  // of half the angle between the edges
  bool acute = dot(from_next, from_previous) > 0.0;
  vec3 outwards = acute ? from_next + from_previous : cross(apart, ray);
  return unit(outwards) * min(1.0 / max(half_sine, 1e-30), largest_miter);
}

// By how much a corner that moves across its ray has to move along it too, so that it does not fall behind a plane.
// `outwards`: the plane's normal, to the side on which it must be.
float lead(vec3 way, vec3 ray, vec3 outwards) {
  return min(max(-dot(way, outwards), 0.0) / max(abs(dot(ray, outwards)), 1e-30), longest_lead);
}

float margin_at(vec3 position) { return margin * abs((to_clip * vec4(position, 1.0)).w); }

// Where the last of the rays through the triangle leaves the receivers' box: of a sun, metres from the triangle, of a
// lamp, times the distance of the triangle. Each plane of the box that the rays cross outwards is such a bound.
float end_of(vec3 corners[3], float plane_distance) {
#if LAMP
  for (int i = 0; i < 3; ++i) corners[i] -= light.xyz;
  vec3 low = receivers_min.xyz - light.xyz, high = receivers_max.xyz - light.xyz;
  float end = min(length(max(abs(low), abs(high))) / plane_distance, longest);
#else
  vec3 low = receivers_min.xyz, high = receivers_max.xyz;
  float end = 1e30;
#endif
  vec3 least = min(corners[0], min(corners[1], corners[2]));
  vec3 greatest = max(corners[0], max(corners[1], corners[2]));
  for (int axis = 0; axis < 3; ++axis) {
#if LAMP
    if (least[axis] > 0.0) end = min(end, high[axis] / least[axis]);
    if (greatest[axis] < 0.0) end = min(end, low[axis] / greatest[axis]);
#else
    float ray = -light[axis];
    if (ray > 0.0) end = min(end, (high[axis] - least[axis]) / ray);
    if (ray < 0.0) end = min(end, (low[axis] - greatest[axis]) / ray);
#endif
  }
  return end;
}

void emit_corner(vec3 position, vec3 sorted[3]) {
  corner_a = sorted[0];
  corner_b = sorted[1];
  corner_c = sorted[2];
  gl_Position = to_clip * vec4(position, 1.0);
  EmitVertex();
}

// Seen from outside of the volume, the corners are in counter-clockwise order.
void emit_if_seen_from_inside(vec3 a, vec3 b, vec3 c, vec3 sorted[3]) {
  if (dot(cross(b - a, c - a), eye.xyz - eye.w * a) >= 0.0) return;
  emit_corner(a, sorted);
  emit_corner(b, sorted);
  emit_corner(c, sorted);
  EndPrimitive();
}

void main() {
  vec3 corners[3];
  for (int i = 0; i < 3; ++i) corners[i] = gl_in[i].gl_Position.xyz - camera.xyz;
  vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  float along = dot(normal, towards_light(corners[0]));
  if (along == 0.0) return;  // it has no area as seen from the light, or is one that casts no shadow
  if (along < 0.0) {
    vec3 second = corners[1];
    corners[1] = corners[2];
    corners[2] = second;
  }
#if LAMP
  vec3 away = vec3(length(towards_light(corners[0])), length(towards_light(corners[1])),
                   length(towards_light(corners[2])));
  if (max(away.x, max(away.y, away.z)) < nearest) return;
  float begin = 1.0;
#else
  vec3 away = vec3(1e30);
  float begin = 0.0;
#endif
  float end = end_of(corners, abs(along) / length(normal));
  if (!(end > begin)) return;

  vec3 lit_normal = normal * (along < 0.0 ? -1.0 : 1.0) / length(normal);
  vec3 near[3], far[3];
  for (int i = 0; i < 3; ++i) {
    vec3 corner = corners[i], ray = ray_at(corner);
    vec3 way = miter(corners[(i + 2) % 3], corner, corners[(i + 1) % 3], ray);
#if LAMP
    vec3 last = light.xyz + end * (corner - light.xyz);
#else
    vec3 last = corner + end * ray;
#endif
    float near_margin = margin_at(corner), far_margin = margin_at(last);
    near[i] = corner + near_margin * way - min(near_margin * (1.0 + lead(way, ray, lit_normal)), 0.5 * away[i]) * ray;
    far[i] = last + far_margin * (way + (overhang + lead(way, ray, -lit_normal)) * ray);
  }

  vec3 sorted[3] = corners;
  for (int i = 0; i < 3; ++i) {
    int first = i % 2;
    vec3 one = sorted[first], other = sorted[first + 1];
    bool turned = precedes(other, one);
    sorted[first] = turned ? other : one;
    sorted[first + 1] = turned ? one : other;
  }
  emit_if_seen_from_inside(near[0], near[1], near[2], sorted);
  emit_if_seen_from_inside(far[2], far[1], far[0], sorted);
  for (int i = 0; i < 3; ++i) {
    int next = (i + 1) % 3;
    emit_if_seen_from_inside(near[next], near[i], far[i], sorted);
    emit_if_seen_from_inside(near[next], far[i], far[next], sorted);
  }
}

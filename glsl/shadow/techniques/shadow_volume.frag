// Writes the mask of receivers that a triangle shadows: those behind it, between the planes through its edges and the
// light (Sintorn et al. 2011, section 3). LAMP: 1 for a lamp.
#include "shadow/techniques/shadow_volume.glsl"

layout(binding = 8) uniform sampler2D places;  // of the receivers

flat in vec3 corner_a, corner_b, corner_c;

layout(location = 0) out vec4 mask;

// On which side of the plane through an edge and the light a position is. Triangles with a common edge have its ends in
// the same order, so they get the same number, and none of the positions is outside of both. `precise` does not reach
// into functions, so none is called.
float side(vec3 from, vec3 to, vec3 position) {
  precise vec3 ray = light.xyz - light.w * from, edge = to - from, way = position - from;
  precise vec3 normal = ray.yzx * edge.zxy - ray.zxy * edge.yzx;
  precise float distance = normal.x * way.x + normal.y * way.y + normal.z * way.z;
  return distance;
}

const float rounding = exp2(-24.0);  // of a float, as a share of it

// How far a position is before the triangle's plane, on the light's side, times twice the triangle's area; and how much
// of that may be due to rounding, which is more than what receivers are moved by if a triangle is large.
float distance_before(vec3 position, float turn, vec3 normal) {
  vec3 ab = corner_b - corner_a, ac = corner_c - corner_a, way = position - corner_a;
  vec3 parts = abs(ab.yzx * ac.zxy) + abs(ab.zxy * ac.yzx);
  return turn * dot(normal, way) + 4.0 * rounding * dot(parts, abs(way));
}

// Whether the ray from a lamp to a position crosses the triangle's plane so near to the lamp that nothing shadows
// there.
bool in_lamp(vec3 position, vec3 normal) {
#if LAMP
  float share = dot(normal, towards_light(corner_a)) / dot(normal, towards_light(position));
  return share * distance(position, light.xyz) < nearest;
#else
  return false;
#endif
}

void main() {
  vec3 position = texelFetch(places, ivec2(gl_FragCoord.xy), 0).xyz;
  vec3 normal = cross(corner_b - corner_a, corner_c - corner_a);
  float turn = dot(normal, towards_light(corner_a)) < 0.0 ? -1.0 : 1.0;
  float before = distance_before(position, turn, normal);
  float on_ab = turn * side(corner_a, corner_b, position);
  float on_bc = turn * side(corner_b, corner_c, position);
  float on_ac = turn * side(corner_a, corner_c, position);
  if (before >= 0.0 || min(on_ab, on_bc) < 0.0 || on_ac > 0.0 || in_lamp(position, normal)) discard;
  mask = vec4(0.0);
}

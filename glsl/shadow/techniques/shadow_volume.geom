// The shadow volume of one triangle: a tetrahedron of which one corner is the point at infinity where a sun's rays
// meet, or a frustum that ends at infinity, where a lamp's rays do. It is closed by itself, so no triangle needs to
// know its neighbours. LAMP: 1 for a lamp.
#include "shadow/light_projection.glsl"

layout(triangles) in;
#if LAMP
layout(triangle_strip, max_vertices = 24) out;
#else
layout(triangle_strip, max_vertices = 12) out;
#endif

layout(std140, binding = 2) uniform Volumes {
  mat4 world_to_camera_clip;
  vec4 apex;   // clip space; of a lamp: minus its centre
  vec4 light;  // world, homogeneous
  // How far from infinity a lamp's volumes end: 0, or a small share of the way where the camera's rays are parallel, so
  // that nothing at infinity is on the picture.
  float short_of;
  float nearest;  // metres: triangles nearer to a lamp are a part of it
};

// Triangles with a common edge must get the same positions for its ends, so that nothing is left between their volumes.
invariant gl_Position;

void emit(vec4 a, vec4 b, vec4 c) {
  gl_Position = a;
  EmitVertex();
  gl_Position = b;
  EmitVertex();
  gl_Position = c;
  EmitVertex();
  EndPrimitive();
}

// An order of positions, whichever: it is the same for both triangles of an edge.
bool precedes(vec4 a, vec4 b) { return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.w < b.w; }

#if LAMP
// Where the ray from the lamp through a corner leaves the volume.
vec4 at_end(vec4 corner) { return corner * (1.0 + short_of) + apex; }
#endif

// A side's depths are rounded in a way that depends on the corner with which it begins, and where the clipper cuts it
// into several triangles, it does so from there. So both sides at a common edge begin with the same corner.
void emit_side(vec4 from, vec4 to) {
#if LAMP
  vec4 far_from = at_end(from), far_to = at_end(to);
  if (precedes(from, to)) {
    emit(from, to, far_to);
    emit(from, far_to, far_from);
  } else {
    emit(to, far_from, from);
    emit(to, far_to, far_from);
  }
#else
  if (precedes(from, to)) {
    emit(from, to, apex);
  } else {
    emit(to, apex, from);
  }
#endif
}

void main() {
  vec3 a = gl_in[0].gl_Position.xyz;
  vec3 b = gl_in[1].gl_Position.xyz;
  vec3 c = gl_in[2].gl_Position.xyz;
#if LAMP
  float along = dot(cross(b - a, c - a), a - light.xyz);
  float farthest = max(distance(a, light.xyz), max(distance(b, light.xyz), distance(c, light.xyz)));
  if (farthest < nearest) return;
#else
  float along = light_direction(cross(b - a, c - a)).z;
#endif
  if (along == 0.0) return;  // it has no area as seen from the light, or is one that casts no shadow
  vec4 corners[3] = vec4[](world_to_camera_clip * gl_in[0].gl_Position, world_to_camera_clip * gl_in[1].gl_Position,
                           world_to_camera_clip * gl_in[2].gl_Position);
  // Seen from outside of the volume, the corners of each face are in counter-clockwise order.
  int second = along < 0.0 ? 1 : 2;
  vec4 last = corners[3 - second];
  emit(corners[0], corners[second], last);
  emit_side(corners[second], corners[0]);
  emit_side(last, corners[second]);
  emit_side(corners[0], last);
#if LAMP
  emit(at_end(last), at_end(corners[second]), at_end(corners[0]));
#endif
}

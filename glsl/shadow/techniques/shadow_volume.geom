// The shadow volume of one triangle: a tetrahedron of which one corner is the point at infinity where the light's rays
// meet. It is closed by itself, so no triangle needs to know its neighbours.
#include "shadow/light_projection.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 12) out;

layout(std140, binding = 2) uniform Volumes {
  mat4 world_to_camera_clip;
  vec4 apex;  // clip space
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

// A side's depths are rounded in a way that depends on the corner with which it begins, and where the clipper cuts it
// into several triangles, it does so from there. So both sides at a common edge begin with the same corner.
void emit_side(vec4 from, vec4 to) {
  if (precedes(from, to)) {
    emit(from, to, apex);
  } else {
    emit(to, apex, from);
  }
}

void main() {
  vec3 a = gl_in[0].gl_Position.xyz;
  vec3 b = gl_in[1].gl_Position.xyz;
  vec3 c = gl_in[2].gl_Position.xyz;
  float along = light_direction(cross(b - a, c - a)).z;
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
}

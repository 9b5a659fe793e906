// For surfaces that are drawn forward: the visibility of a point in view space with a geometric normal in world space.
#include "shadow/light.glsl"
#include "shadow/receive.glsl"

float shadow_visibility(vec3 view_position, vec3 geometric_normal, vec2 pixel) {
  Receiver receiver = make_receiver(view_position, light_direction(geometric_normal), pixel);
  // The caller may have made the position from stored depths.
  receiver.depth_error = vertex_error(plane_moves(receiver), view_position);
  return shadow_of(receiver, light_for(receiver)).visibility.visibility;
}

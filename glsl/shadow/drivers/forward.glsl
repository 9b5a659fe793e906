// For surfaces that are drawn forward: the visibility of a point in view space with a geometric normal in world space.
#include "shadow/receive.glsl"
#include "shadow/drivers/receiver.glsl"

float shadow_visibility(vec3 view_position, vec3 geometric_normal, vec2 pixel) {
  Receiver receiver = make_receiver(view_position, mat3(shadow.world_to_light) * geometric_normal, pixel);
  return shadow_of(receiver, light_for(receiver)).visibility.visibility;
}

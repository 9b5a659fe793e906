#include "shadow/light.glsl"

// A receiver from view space (camera) position and light-space normal.
Receiver make_receiver(vec3 view_position, vec3 light_normal, vec2 pixel) {
  Receiver receiver;
  receiver.position = mat3(shadow.view_to_light) * view_position;
  receiver.normal = light_normal;
  receiver.gradient = plane_gradient(light_normal, max_plane_slope);
  receiver.corner = Corner(vec4(0.0), 0.0);
  receiver.pixel = pixel;
  receiver.renewed = false;
  return receiver;
}

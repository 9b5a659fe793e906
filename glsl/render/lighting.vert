// A triangle over the whole viewport, for passes that light pixels: the ray through each, and the light from all
// around. That is the same for all pixels, but reading it from a uniform block costs each group of pixels in software.
#include "shared/lighting_block.h"
#include "shared/view_block.h"

layout(std140, binding = 4) uniform ViewData { ViewBlock view; };
layout(std140, binding = 5) uniform LightingData { LightingBlock lighting; };

layout(location = 0) noperspective out vec3 view_ray;  // of any length
layout(location = 1) flat out AmbientLight ambient;

void main() {
  vec2 ndc = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  gl_Position = vec4(ndc, 0.0, 1.0);
  view_ray = view.forward.xyz + ndc.x * view.ray_x.xyz + ndc.y * view.ray_y.xyz;
  ambient = lighting.ambient;
}

// Writes the G-buffer.
#include "lib/octahedral.glsl"
#include "scene/surface.glsl"

layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec2 out_normal;
layout(location = 2) out vec2 out_geometric_normal;
layout(location = 3) out vec4 out_material;
layout(location = 4) out vec3 out_emission;
layout(location = 5) out vec2 out_motion;

void main() {
  vec4 color = base_color(surface.uv, surface.color);
  vec3 geometric = geometric_normal();
  vec3 properties = surface_properties(surface.uv);
  out_albedo = vec4(sqrt(clamp(color.rgb, 0.0, 1.0)), 0.0);  // square root: less banding in ten bits
  out_normal = octahedral_encode(shading_normal(geometric)) * 0.5 + 0.5;
  out_geometric_normal = octahedral_encode(geometric);
  out_material = vec4(properties, is_unlit() ? 1.0 : 0.0);
  out_emission = min(emission(surface.uv), vec3(64000.0));
  out_motion = motion();
#if MASKED
  if (color.a < material.alpha_cutoff) discard;  // last: mip levels need the derivatives of the whole quad
#endif
}

// Writes the G-buffer of the surfaces that an earlier pass has left in the depth buffer.
#include "lib/octahedral.glsl"
#include "scene/surface.glsl"

layout(location = 0) out vec4 out_albedo;
layout(location = 1) out vec2 out_normal;
layout(location = 2) out vec2 out_geometric_normal;
layout(location = 3) out vec4 out_material;
#if EMISSION
layout(location = 4) out vec3 out_emission;
#endif
#if MOTION
layout(location = 4 + EMISSION) out vec2 out_motion;
#endif

void main() {
  vec4 color = surface_color();
  vec3 geometric = geometric_normal();
  vec3 properties = surface_properties(surface_uv());
  // Square root: less banding in ten bits. Alpha: 0 is left where no surface is.
  out_albedo = vec4(sqrt(clamp(color.rgb, 0.0, 1.0)), is_unlit() ? 1.0 / 3.0 : 1.0);
  out_normal = octahedral_encode(shading_normal(geometric)) * 0.5 + 0.5;
  out_geometric_normal = octahedral_encode(geometric);
  out_material = vec4(properties, smooth_lean());
#if EMISSION
  vec3 emitted = emission(surface_uv());
  out_emission = emitted * min(1.0, 64000.0 / max(max(emitted.r, emitted.g), max(emitted.b, 1.0)));  // as can be stored
#endif
#if MOTION
  out_motion = motion();
#endif
  cut_out(color.a);
}

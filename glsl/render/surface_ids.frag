// Writes which triangle of which surface each pixel shows.
#include "scene/surface.glsl"

layout(location = 0) out uvec2 out_id;  // surface plus 1, triangle

void main() {
#if MASKED
  if (base_color(surface.uv, surface.color).a < material.alpha_cutoff) discard;
#endif
  out_id = uvec2(surface.instance + 1u, uint(gl_PrimitiveID));
}

// Writes which triangle of which surface each pixel shows.
#include "scene/surface.glsl"

layout(location = 0) out uvec2 out_id;  // surface plus 1, triangle

void main() {
  out_id = uvec2(surface.instance + 1u, uint(gl_PrimitiveID));
  cut_out(surface_color().a);
}

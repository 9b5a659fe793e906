// Transparent (alpha-blended) surfaces, drawn over the lit picture. Included after a technique's forward driver, which
// gives shadow_visibility().
#include "scene/surface.glsl"
#include "render/shade.glsl"

layout(location = 0) out vec4 blended;

uniform mat4 world_to_view;

void main() {
  vec4 color = surface_color();
  float alpha = clamp(color.a, 0.0, 1.0);
  vec3 geometric = normalize(geometric_normal());
  vec3 properties = surface_properties(surface_uv());
  Shading s;
  s.position = surface.world;
  s.albedo = clamp(color.rgb, 0.0, 1.0);
  s.normal = shading_normal(geometric);
  s.smooth_lean = smooth_lean();
  s.to_eye = -normalize(view_ray());
  s.emission = emission(surface_uv());
  s.metallic = properties.x;
  s.roughness = properties.y;
  s.occlusion = properties.z;
  vec3 radiance = s.albedo;
  if (!is_unlit()) {
    vec3 view_position = (world_to_view * vec4(surface.world, 1.0)).xyz;
    Reflection r = reflection_of(s);
    radiance = unshadowed_light(s, r, lighting.ambient);
    // The forward driver reads the shadow map of the first light only.
    add_light(radiance, s, r, 0, shadow_visibility(view_position, geometric, gl_FragCoord.xy - 0.5));
    for (int i = 1; i < lighting.light_count; ++i) add_light(radiance, s, r, i, 1.0);
    radiance = storable(radiance);
  }
  blended = vec4(radiance * alpha, alpha);
}

// What pixels show where no surface is: the sky and, below the horizon, the ground around the scene, which is lit
// without shadows.
#include "shared/view_block.h"
#include "render/shade.glsl"

layout(std140, binding = 4) uniform ViewData { ViewBlock view; };
layout(location = 0) noperspective in vec3 view_ray;  // as in lighting.vert
layout(location = 1) flat in AmbientLight ambient;

layout(binding = 8) uniform sampler2D sky_table;  // linear

const float haze_of_reach = 0.5;  // halvings of what is seen of the ground, for each distance of the scene's end

// How much of the ground the air hides at a distance in metres: none as far as the scene reaches, and all at the
// horizon.
float haze(float distance) {
  float reaches = distance / lighting.scene_reach;
  return view.camera.w == 1.0 ? 0.0 : 1.0 - exp2(haze_of_reach * min(1.0 - reaches, 0.0));
}

// Distance along a ray that points downwards, from a place to the ground.
float to_ground(vec3 from, vec3 ray) { return abs(from.y - lighting.ground_height) / max(-ray.y, 1e-5); }

#if LAMPS
uniform mat4 clip_to_world;

vec3 ground_at(vec3 ray) {
  vec2 ndc = gl_FragCoord.xy * view.viewport.zw * 2.0 - 1.0;
  vec4 near = clip_to_world * vec4(ndc, 1.0, 1.0);
  near.xyz /= near.w;
  return near.xyz + ray * to_ground(near.xyz, ray);
}
#endif

layout(location = 0) out vec4 lit;

void main() {
  vec3 ray = normalize(view_ray);
  // The ground fades into the sky above it.
  vec2 place = sky_place(vec3(ray.x, abs(ray.y), ray.z), ambient.sun_side);
  vec2 size = vec2(textureSize(sky_table, 0));  // its outermost texels are at places 0 and 1
  vec3 color = lighting.sky * textureLod(sky_table, (place * (size - 1.0) + 0.5) / size, 0.0).rgb + lighting.room;
  if (ray.y < 0.0) {
    Shading s;
#if LAMPS
    s.position = ground_at(ray);
#endif
    s.albedo = lighting.ground_albedo;
    s.normal = vec3(0.0, 1.0, 0.0);
    s.smooth_lean = 0.0;
    s.to_eye = -ray;
    s.emission = vec3(0.0);
    s.metallic = 0.0;
    s.roughness = 1.0;
    s.occlusion = 1.0;
    Reflection r = reflection_of(s);
    vec3 radiance = unshadowed_light(s, r, ambient);
    for (int i = 0; i < LIGHTS; ++i) add_light(radiance, s, r, i, 1.0);
    // By their logarithms: a dazzling sky would hide the ground farther from the horizon than a dull one does, and the
    // horizon would look tilted.
    color = exp2(mix(log2(max(radiance, 1e-6)), log2(max(color, 1e-6)), haze(to_ground(view.camera.xyz, ray))));
  }
  lit = vec4(storable(color), 1.0);
}

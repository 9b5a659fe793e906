// The material of the current draw, and its textures.
#include "shared/scene_blocks.h"

// A uniform block, because storage buffer reads may be skipped in helper invocations, whose texture coordinates are
// needed for derivatives.
layout(std140, binding = 6) uniform MaterialData { MaterialBlock material; };

layout(binding = 8) uniform sampler2D base_color_texture;
layout(binding = 9) uniform sampler2D metallic_roughness_texture;
layout(binding = 10) uniform sampler2D normal_texture;
layout(binding = 11) uniform sampler2D occlusion_texture;
layout(binding = 12) uniform sampler2D emissive_texture;

// Whether a material of this program may have a texture. TEXTURES: bit i: one of them has texture i.
bool may_have_texture(int which) { return (TEXTURES & (1 << which)) != 0; }

// Where to read a texture, given both UV sets. TRANSFORMS: bit i: materials of this program may read texture i
// otherwise than at the first set as it is.
vec2 texture_uv(int which, vec4 uv) {
  if ((TRANSFORMS & (1 << which)) == 0) return uv.xy;
  bool second = (material.flags & (1u << which)) != 0u;
  vec3 at = vec3(second ? uv.zw : uv.xy, 1.0);
  return vec2(dot(material.uv_rows[2 * which].xyz, at),
              dot(material.uv_rows[2 * which + 1].xyz, at));
}

vec4 base_color(vec4 uv, vec4 vertex_color) {
  vec4 color = material.base_color * vertex_color;
  if (may_have_texture(TEXTURE_BASE_COLOR)) {
    vec4 texel = texture(base_color_texture, texture_uv(TEXTURE_BASE_COLOR, uv));
    color *= texel * material.has_base_color + (1.0 - material.has_base_color);
  }
  return color;
}

vec3 emission(vec4 uv) {
  vec3 emissive = material.emissive;
  if (may_have_texture(TEXTURE_EMISSIVE)) {
    vec3 texel = texture(emissive_texture, texture_uv(TEXTURE_EMISSIVE, uv)).rgb;
    emissive *= texel * material.has_emissive + (1.0 - material.has_emissive);
  }
  return emissive;
}

// Metallic, roughness, occlusion.
vec3 surface_properties(vec4 uv) {
  vec3 properties = vec3(material.metallic, material.roughness, 1.0);
  if (may_have_texture(TEXTURE_METALLIC_ROUGHNESS)) {
    vec2 texel = texture(metallic_roughness_texture, texture_uv(TEXTURE_METALLIC_ROUGHNESS, uv)).bg;
    properties.xy *= texel * material.has_metallic_roughness + (1.0 - material.has_metallic_roughness);
  }
  if (may_have_texture(TEXTURE_OCCLUSION)) {
    float occlusion = texture(occlusion_texture, texture_uv(TEXTURE_OCCLUSION, uv)).r;
    properties.z = 1.0 + material.occlusion_strength * (occlusion - 1.0);
  }
  return properties;
}

bool is_unlit() { return (material.flags & MATERIAL_UNLIT) != 0u; }

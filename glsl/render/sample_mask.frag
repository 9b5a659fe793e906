// Writes a light's shadow mask of a further sample of each pixel: the first one's, interpolated as for lighting.
#include "lib/octahedral.glsl"
#include "shared/view_block.h"

layout(std140, binding = 4) uniform ViewData { ViewBlock view; };
layout(binding = 8) uniform sampler2DArray shadow_mask;
layout(binding = 9) uniform sampler2D gbuffer_depth;
layout(binding = 10) uniform sampler2D gbuffer_geometric_normal;
layout(binding = 11) uniform sampler2D first_depth;
layout(binding = 12) uniform sampler2D first_normal;  // geometric
#include "render/first_mask.glsl"
#include "render/position_at.glsl"

uniform int light;

layout(location = 0) out vec4 mask;

// Of values of which 0 means that there is none.
float mean_of_valid(vec4 weights, vec4 values) {
  vec4 valid = weights * vec4(notEqual(values, vec4(0.0)));
  float sum = dot(valid, vec4(1.0));
  return sum > 0.0 ? dot(valid, values) / sum : 0.0;
}

vec4 first_mask(ivec2 texel) { return texelFetch(shadow_mask, ivec3(in_picture(texel), light), 0); }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (texelFetch(gbuffer_depth, pixel, 0).x == 0.0) {
    mask = vec4(1.0, 0.0, 0.0, 0.0);  // the sky
    return;
  }
  vec3 normal = octahedral_decode(texelFetch(gbuffer_geometric_normal, pixel, 0).xy);
  MaskTexels at = mask_texels(pixel, sample_surface(position_at(pixel), normal));
  ivec2 first = at.first;
  mat4 texels = transpose(mat4(first_mask(first), first_mask(first + ivec2(1, 0)), first_mask(first + ivec2(0, 1)),
                               first_mask(first + 1)));
  mask = vec4(dot(at.weights, texels[0]), mean_of_valid(at.weights, texels[1]), mean_of_valid(at.weights, texels[2]),
              0.0);
}
